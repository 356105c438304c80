// Arcs: the form of the last segment of a path.
#pragma once

#include <optional>

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

/// The same on a last segment: an arc where it begins in a fixed direction, otherwise the straight line to `end`.
PlaceOnPath place_on_segment(const Point& anchor, const std::optional<Point>& start, const Point& end, double length);

constexpr double place_of_corner = 0.75;  ///< along the arc from its anchor, over its length

/// The corner of two straight pieces that replace an arc from the anchor to `end` which begins in the direction
/// `start`. It lies on the tangent at the end, so that the last piece has the direction of the arc there. Its place on
/// the tangent makes T act on K_II as along the arc: the integral of the direction over the square root of the distance
/// from the tip is the same, to first order in the turn (Cotterell and Rice, Int. J. Fract. 16 (1980) 155). An arc that
/// turns by more than 0.8 rad is not followed.
Point corner_of_arc(const Point& anchor, const Point& start, const Point& end);

}  // namespace sprekk::fine_fracture
