// The geometry of a fine level without its last digits, for which its triangulation is made.
#pragma once

#include <vector>

#include "components/fine_fracture/fine_level/geometry.hpp"
#include "components/fine_fracture/quarter_point/mesh/room.hpp"
#include "framework/triangulation/rounded_drawing.hpp"

namespace sprekk::fine_fracture {

/// A geometry on a coarse grid in its frame (rounded_points), with the same topology as the given one, and the rooms of
/// its tips. Geometries that differ by round-off have the same bits, and so have those that are images of one another
/// under a shift or half a turn (up to the order and direction of their cracks).
struct RoundedGeometry {
  DrawingFrame frame;
  FineGeometry geometry;
  std::vector<TipRoom> rooms;              ///< position, direction and radius; nothing else
  std::vector<std::vector<double>> bends;  ///< rad, of the given geometry, by crack and point
};

/// `anchor`: the origin of the frame, m; a place that stays where it is while cracks grow keeps the rounding of their
/// older points. `rooms`: those of tip_rooms with StraightPoints::end_it, so that no rosette has a point of a path in
/// it.
RoundedGeometry rounded_geometry(const FineGeometry& geometry, const std::vector<TipRoom>& rooms, const Point& anchor);

/// The bends of all paths at their points, rad; 0 at their ends.
std::vector<std::vector<double>> bends_of(const FineGeometry& geometry);

}  // namespace sprekk::fine_fracture
