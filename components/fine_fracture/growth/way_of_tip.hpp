// Where a tip has been while its last segment grew.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// The place (m) of a tip when its last segment, which begins at the anchor, was `length` (m) long. A segment turns
/// while it grows, so this place is not on the segment that the tip has now. `way`: places of the tip at ends of steps,
/// of which each is farther from the anchor than the one before; the last one is at least as far as the length. Between
/// two places the direction from the anchor is linear in the distance, and up to the first one it is constant.
Point place_on_way(const Point& anchor, const std::vector<Point>& way, double length);

}  // namespace sprekk::fine_fracture
