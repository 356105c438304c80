// Where a tip has been while its last segment grew, and the form of this segment.
#pragma once

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
/// two places the direction from the anchor, and that of the path, are linear in the distance; both are constant up to
/// the first place.
PlaceOnWay place_on_way(const Point& anchor, const std::vector<PlaceOnWay>& way, double length);

/// The place on the arc from the anchor to `end` that begins in the direction `start` and bends by one curvature, at
/// this distance (m) from the anchor. An arc from there to `end` is a part of the whole one. An arc that turns by more
/// than 0.8 rad is not followed.
PlaceOnWay place_on_arc(const Point& anchor, const Point& start, const Point& end, double length);

/// The corners, from the anchor on, of straight pieces that stand for an arc from the anchor to `end` which begins in
/// the direction `start`. The pieces are tangents of the arc at equal distances, with those at both ends among them:
/// the last piece has the direction of the arc at its end. First and last one are half as long as the others. An arc
/// that turns by more than 0.8 rad is not followed.
std::vector<Point> corners_of_arc(const Point& anchor, const Point& start, const Point& end);

}  // namespace sprekk::fine_fracture
