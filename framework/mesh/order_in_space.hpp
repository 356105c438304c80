// An order of points in which those that follow one another lie close together.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// The numbers of the points along Hilbert's curve over their bounding box; points in one place in ascending order.
/// What is visited in this order meets its neighbours' data while they are still in the cache.
std::vector<int> order_in_space(const std::vector<Point>& points);

}  // namespace sprekk
