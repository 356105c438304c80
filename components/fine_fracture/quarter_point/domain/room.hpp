// How much room there is around a tip: for its rosette, and for the domain of an interaction integral.
#pragma once

#include <vector>

#include "components/fine_fracture/quarter_point/domain/geometry.hpp"

namespace sprekk::fine_fracture {

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

/// All tips with their rooms. The radius of a rosette is `largest_radius` unless this is more than half of the
/// straight end (a third, if that ends in two tips), of its part with the same kind of walls, or of the distance to
/// anything else (a third of that to other cracks and to the other tip of its own).
std::vector<TipRoom> tip_rooms(const FineGeometry& geometry, double largest_radius);

}  // namespace sprekk::fine_fracture
