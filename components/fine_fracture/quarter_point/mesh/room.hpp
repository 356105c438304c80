// The room around a tip for its rosette, and for the domain of an interaction integral.
#pragma once

#include <vector>

#include "components/fine_fracture/fine_level/geometry.hpp"

namespace sprekk::fine_fracture {

/// What points in the straight end of a crack do, at which the kind of walls stays the same. Where rooms are to be
/// continuous in the bends of a path, they end the straight end, however small the bend is there.
enum class StraightPoints { nothing, end_it };

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

/// All tips with their rooms. The radius of a rosette is the least of: `largest_radius` (m); half of the straight end
/// of the crack (a third, if this has two tips); half of its part with the same kind of walls; a third of the distance
/// to other cracks and to the other tip of its own crack; half of the distance to anything else.
std::vector<TipRoom> tip_rooms(const FineGeometry& geometry, double largest_radius,
                               StraightPoints points = StraightPoints::nothing);

}  // namespace sprekk::fine_fracture
