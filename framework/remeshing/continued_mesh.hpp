// The mesh that has been, with the cells of tips prepared to go on in it.
#pragma once

#include <optional>
#include <vector>

#include "framework/remeshing/extend_fractures.hpp"

namespace sprekk {

/// The given mesh as what extend_fractures could have made of itself, for paths that replace the last cell of their
/// fracture by one segment, or by two: then the last cell is divided, with the two triangles beside it, where the first
/// point is along it. Nothing else changes, and nothing moves: move_tips puts the ends where the paths want them. So a
/// tip that goes on keeps the mesh around it, and a state that is carried over meets no other discretization. All cells
/// of the cavity may move; they count as new.
///
/// Nothing for other paths, and where a cell that would have to move is no triangle.
std::optional<GrownMesh> continued_mesh(const Mesh& mesh, const std::vector<PathExtension>& extensions,
                                        const CavityOptions& options);

}  // namespace sprekk
