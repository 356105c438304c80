// Growth of fractures: the mesh around their tips is removed and made anew along the new path, the rest stays.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/remeshing/extension_check.hpp"

namespace sprekk {

struct CavityOptions {
  /// Cells whose centre is nearer than this to the old tip or the new path are made anew, m (sec. 4.1 of the paper:
  /// five times the length of growth). Cells next to those that the path crosses always are.
  double radius;
  double size;    ///< edge length at the new path, m
  double growth;  ///< by how many m the edge length grows per m of distance from the path, where the rim lets it
  /// Where the outer boundary or another fracture is nearer than `size` times this, edges of the path are as long as
  /// the gap over this; 0 leaves gaps alone.
  double gap_edges = 0.5;
};

struct GrownMesh {
  Mesh mesh;
  MeshChange change;
  double smallest_angle;  ///< rad, of the new cells
  /// Per extension: its fracture cells, from the old tip on.
  std::vector<std::vector<int>> extension_cells;
};

/// Extends fractures. Each given segment becomes one or more fracture cells of about `size`, shorter in narrow gaps.
/// All that is older stays as it is: fracture cells, interfaces between regions, and the outer boundary, whose edges
/// may be divided near a path. Cells outside of the cavity keep their corners; they keep their numbers, too, unless
/// there are fewer cells than before: then the last ones move to the lowest free numbers. What is made anew is
/// triangles, whatever was there. An end within a hundredth of `size` of the outer boundary is put onto it and becomes
/// on_boundary. One as near to a point of another fracture joins it there, in a junction. When an angle falls below 25
/// degrees, further cavities are tried and the best is taken. Throws ExtensionError, before any work, for paths that
/// are refused (see check_extensions), std::invalid_argument for options that are not positive, and std::runtime_error
/// when the cavity cannot be meshed.
GrownMesh extend_fractures(const Mesh& mesh, const std::vector<PathExtension>& extensions,
                           const CavityOptions& options);

}  // namespace sprekk
