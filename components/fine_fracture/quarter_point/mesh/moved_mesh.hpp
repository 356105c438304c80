// The triangulation of a fine level for another geometry with the same topology.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "components/fine_fracture/fine_level/geometry.hpp"
#include "components/fine_fracture/quarter_point/mesh/outside_mesh.hpp"
#include "components/fine_fracture/quarter_point/mesh/room.hpp"
#include "components/fine_fracture/quarter_point/mesh/rounded_geometry.hpp"
#include "framework/remeshing/spread_motion.hpp"

namespace sprekk::fine_fracture {

/// A triangulation with its rosettes, and what it was made for, in its own frame.
struct Triangulated {
  DrawingFrame frame;
  FineGeometry geometry;
  std::vector<TipRoom> rooms;
  OutsideMesh mesh;            ///< with the triangles of the rosettes and the tips
  std::vector<Point> outline;  ///< m, of the geometry that was first wanted
  /// How nodes follow, in its frame, and its smallest angle (rad): found when it is moved first.
  struct Followers {
    SpreadMotion motion;
    double smallest_angle;
  };
  mutable std::shared_ptr<const Followers> followers = {};
};

/// The triangulation `made` with its nodes moved to another geometry, whose rooms are given: nodes of the outline and
/// of the cracks keep their part of an edge, rosettes move as a whole, all others follow (spread_motion). Positions are
/// continuous in the points of the geometry. Nothing where the topology is another, or where a triangle would turn over
/// or have an angle of less than half of the smallest one.
std::optional<OutsideMesh> moved_mesh(const Triangulated& made, const FineGeometry& geometry,
                                      const std::vector<TipRoom>& rooms);

}  // namespace sprekk::fine_fracture
