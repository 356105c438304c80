// Where a tip has been while its last segment grew, and the form of this segment.
#pragma once

#include <optional>
#include <vector>

#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// A place where a tip has been with K_II = 0, and the direction of its path there.
struct PlaceOnWay {
  Point position;   ///< m
  Point direction;  ///< unit vector
};

/// The place of a tip when its last segment, which begins at the anchor, was `length` (m) long. A segment turns
/// while it grows, so this place is not on the segment that the tip has now. `way`: places of the tip at ends of steps,
/// of which each is farther from the anchor than the one before; the last one is at least as far as the length. Between
/// two places the direction from the anchor, and that of the path, are linear in the distance. `start`: the direction
/// of the path at the anchor; without one both are constant up to the first place.
PlaceOnWay place_on_way(const Point& anchor, const std::optional<Point>& start, const std::vector<PlaceOnWay>& way,
                        double length);

/// The middle point of two straight pieces that stand for an arc from the anchor to `end` which begins in the direction
/// `start`: the intersection of its tangents, so that the second piece has the direction of the arc at its end. An arc
/// that turns by more than 0.8 rad is not followed.
Point middle_of_arc(const Point& anchor, const Point& start, const Point& end);

}  // namespace sprekk::fine_fracture
