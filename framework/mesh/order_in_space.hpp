// An order of points in which consecutive points lie close together.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// The numbers of the points along Hilbert's curve over their bounding box; points in one place are in ascending order.
/// A loop in this order finds the data of neighbours in the cache.
std::vector<int> order_in_space(const std::vector<Point>& points);

}  // namespace sprekk
