// The room around a tip for its rosette, and for the domain of an interaction integral.
#pragma once

#include <vector>

#include "components/fine_fracture/fine_level/geometry.hpp"

namespace sprekk::fine_fracture {

/// What a point of a path does where the path has no bend and one kind of walls on both sides. Either it is passed as
/// if it were not there; or the straight end of the crack ends there, so that rooms are continuous in the bends of the
/// path.
enum class StraightPoints { are_passed, end_it };

/// A tip with the straight end of its crack.
struct TipRoom {
  int crack;
  bool is_last;       ///< the last point of the path, else the first
  Point position;     ///< m
  Point direction;    ///< unit, along the crack and out of it
  double straight;    ///< length of the straight end of the path, m
  double same_walls;  ///< length of its part with the same kind of walls, m
  double clearance;   ///< distance to the nearest thing that is not the straight end, or to another rosette, m
  double radius;      ///< of the rosette, m
};

/// All tips with their rooms. The radius of a rosette is the least of
/// - `largest_radius` (m);
/// - half of the straight end of the crack (a third, if this has two tips), and half of its part with one kind of
/// walls;
/// - a third of the distance to other cracks and to the other tip of its own crack;
/// - half of the distance to anything else.
std::vector<TipRoom> tip_rooms(const FineGeometry& geometry, double largest_radius,
                               StraightPoints points = StraightPoints::are_passed);

}  // namespace sprekk::fine_fracture
