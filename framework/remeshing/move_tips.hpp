// Other positions of new tips in the same mesh.
#pragma once

#include <optional>
#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/remeshing/extend_fractures.hpp"
#include "framework/remeshing/path_extension.hpp"

namespace sprekk {

/// The mesh `grown`, which extend_fractures made from `before` with the same fractures, ends and replaced cells, with
/// other points of the paths. All topology and all numbers stay. Nodes of the cavity move along (spread_motion);
/// at rest are the rim of the cavity, the outer boundary, interfaces between regions, and all other fracture points.
/// Positions, and overlaps with the cells of `before`, are continuous functions of the points; those that `grown` was
/// made with give `grown` again.
///
/// Returns nothing when the mesh must be made anew:
/// - a cell would turn over, or have an angle below six tenths of the smallest angle of `grown`;
/// - segments were divided (except where whole segments cross an interface: these nodes stay, and the path bends
/// there);
/// - a point that lies on the outer boundary, an interface or another fracture would leave it, or one would come there.
///
/// Throws ExtensionError for paths that extend_fractures refuses.
std::optional<GrownMesh> move_tips(const Mesh& before, const GrownMesh& grown,
                                   const std::vector<PathExtension>& extensions, const CavityOptions& options);

}  // namespace sprekk
