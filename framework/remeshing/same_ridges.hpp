// Which points of fractures are the same in two meshes.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Per fracture point of `mesh` the same one of `old`, or none, given the old cell (or none) of each of its fracture
/// cells. Ends of the same cell are the same points; a fracture point of a junction is an old point if its two
/// cells met before.
std::vector<int> same_ridges(const Mesh& old, const Mesh& mesh, const std::vector<int>& old_cell);

}  // namespace sprekk
