// Keeps the mesh around tips that grow further.
#pragma once

#include <optional>
#include <vector>

#include "framework/remeshing/extend_fractures.hpp"

namespace sprekk {

/// Takes the place of extend_fractures for paths that replace the last cell of their fracture by one segment or by
/// two, and returns the given mesh with the cells of the cavity marked as new, since move_tips may move them. For two
/// segments the last cell is divided at the place of the first point along it, and so are the two triangles beside it.
/// Nothing else changes, and nothing moves: move_tips puts the tips where the paths end. So a state that is carried
/// over meets the same discretization around the tip.
///
/// Returns nothing for other paths, and where a cell that would have to move is no triangle.
std::optional<GrownMesh> continued_mesh(const Mesh& mesh, const std::vector<PathExtension>& extensions,
                                        const CavityOptions& options);

}  // namespace sprekk
