// Arcs: the form of the last segment of a path.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// A place of a path, and the direction of the path there.
struct PlaceOnPath {
  Point position;   ///< m
  Point direction;  ///< unit vector
};

/// The place on the arc from the anchor to `end` that begins in the direction `start` and bends by one curvature, at
/// this distance (m) from the anchor. An arc from there to `end` is a part of the whole one. An arc that turns by more
/// than 0.8 rad is not followed.
PlaceOnPath place_on_arc(const Point& anchor, const Point& start, const Point& end, double length);

/// The corners, from the anchor on, of straight pieces that stand for an arc from the anchor to `end` which begins in
/// the direction `start`. The pieces are tangents of the arc at equal distances, with those at both ends among them:
/// the last piece has the direction of the arc at its end. First and last one are half as long as the others. An arc
/// that turns by more than 0.8 rad is not followed.
std::vector<Point> corners_of_arc(const Point& anchor, const Point& start, const Point& end);

}  // namespace sprekk::fine_fracture
