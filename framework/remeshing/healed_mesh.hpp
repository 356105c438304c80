// A mesh in which the last cells of fractures are closed again.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/remeshing/path_extension.hpp"

namespace sprekk {

/// A mesh whose fractures are shorter than those of another one, the given mesh, with the same cells in the same order.
/// Where walls have closed there is one face, and one node where there were two.
struct HealedMesh {
  Mesh mesh;
  std::vector<int> face;           ///< per face: the same one of the given mesh; none where two walls have become one
  std::vector<int> fracture_cell;  ///< per fracture cell: the same one of the given mesh
  std::vector<int> ridge;          ///< per ridge: the same one of the given mesh
  /// Per extension: the fracture cells of the given mesh that have closed, from the anchor on, and where they were.
  std::vector<std::vector<int>> replaced;
  std::vector<std::vector<Segment>> scars;
};

/// Closes the cells that extensions replace. Throws ExtensionError (no_tip or not_replaceable) for ends that lie on the
/// outer boundary or on another fracture, for cells that have not grown, for points (the anchor is one) at which
/// fractures meet, and for paths shorter than what they replace; and std::invalid_argument for numbers out of range.
HealedMesh heal_ends(const Mesh& mesh, const std::vector<PathExtension>& extensions);

}  // namespace sprekk
