// Points that divide a segment into edges of wanted lengths.
#pragma once

#include <functional>
#include <vector>

#include "framework/mesh/plane/planar.hpp"

namespace sprekk {

/// Of an edge, or a segment: places where a wanted length is looked at. Half as many were tried, too.
inline constexpr int samples_of_length = 64;

/// Points that divide the segment into edges of about the length `size` (m) at their place, in the direction of the
/// segment and without its ends; no points when a single edge fits best. With a constant size all edges are equally
/// long.
std::vector<Point> graded_division(const Segment& segment, const std::function<double(const Point&)>& size);

}  // namespace sprekk
