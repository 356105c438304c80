// The part of a mesh around paths, filled with new triangles that have the paths as edges.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "framework/mesh/plane/planar.hpp"
#include "framework/mesh/raw_mesh.hpp"
#include "framework/remeshing/cavity_options.hpp"
#include "framework/remeshing/path_nodes.hpp"

namespace sprekk {

/// New triangles for the cavities. Their corners are numbers in `nodes`, in which the nodes of the placed paths come
/// first.
struct Refill {
  std::vector<bool> is_removed;  ///< per old cell
  std::vector<Point> nodes;
  std::vector<std::array<int, 3>> triangles;
  std::vector<RawMesh::BoundaryFace> boundary_faces;                ///< of the new triangles
  double smallest_angle = std::numeric_limits<double>::infinity();  ///< rad, of the new triangles
  int single_corners = 0;                                           ///< new triangles with two barriers
};

/// Fills the cavities around placed paths. Tries several methods and sizes of cavities until the angles are good, and
/// returns the best result. `raw` and `merged` describe the mesh with closed walls (to_raw_mesh), `segments` are the
/// edges of each placed path, and cells around the `scars` (paths that have closed) are removed as well. Throws
/// std::runtime_error when all of them fail.
Refill refill_cavities(const Mesh& mesh, const RawMesh& raw, const std::vector<int>& merged,
                       const PathNodes& path_nodes, const std::vector<std::vector<Segment>>& segments,
                       const std::vector<std::vector<Segment>>& scars, const CavityOptions& options);

}  // namespace sprekk
