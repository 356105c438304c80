// Which new fracture cells lie in the place of those that were replaced.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk {

/// Lays replaced cells of `old` and the cells of a new path, both in order from the point where they part, along one
/// line, and adds what they share to change.replaced_parts. The end of a path that is shorter (by round-off, or because
/// it was moved to a node) takes the rest.
void add_replaced_parts(const Mesh& old, const std::vector<int>& replaced, const Mesh& mesh,
                        const std::vector<int>& path, MeshChange& change);

}  // namespace sprekk
