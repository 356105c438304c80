// The triangles of the domain outside of the rosettes.
#pragma once

#include <functional>
#include <vector>

#include "components/fine_fracture/fine_level/geometry.hpp"
#include "components/fine_fracture/quarter_point/mesh/room.hpp"
#include "framework/mesh/raw_mesh.hpp"

namespace sprekk::fine_fracture {

/// The corners of a tip's rosette, counter-clockwise from the corner on the crack; their number is `sectors`.
std::vector<Point> rosette_corners(const TipRoom& room, int sectors);

/// The triangles outside of the rosettes, and the nodes at which the rosettes join them.
struct OutsideMesh {
  RawMesh raw;                             ///< sides are the outline's edges; chains lead from rosette to rosette
  std::vector<std::vector<int>> rosettes;  ///< the nodes of the rosettes' corners, by tip
};

/// Meshes the domain outside of the rosettes, whose corners become neighbouring nodes. `size`: the edge length at a
/// place, m.
OutsideMesh mesh_outside(const FineGeometry& geometry, const std::vector<TipRoom>& rooms, int sectors,
                         const std::function<double(const Point&)>& size);

}  // namespace sprekk::fine_fracture
