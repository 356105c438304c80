// Which ridges are the same in two meshes.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Per ridge of `mesh` the same one of `old`, or none. `old_cell`: for each fracture cell of `mesh` the same one of
/// `old`, or none. Ends of the same cell are the same ridges; a ridge of a junction is an old one if its two cells met
/// before.
std::vector<int> same_ridges(const Mesh& old, const Mesh& mesh, const std::vector<int>& old_cell);

}  // namespace sprekk
