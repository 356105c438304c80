// Points that divide a segment into edges of wanted lengths.
#pragma once

#include <functional>
#include <vector>

#include "framework/mesh/planar.hpp"

namespace sprekk {

/// Points inside of the segment, in its direction, such that the edges between them are about as long as `size` (m)
/// says at their place; none when one edge fits best. With a constant size all edges are equally long.
std::vector<Point> graded_division(const Segment& segment, const std::function<double(const Point&)>& size);

}  // namespace sprekk
