// Meshes from files.
#pragma once

#include <string>

#include "framework/config/input_error.hpp"
#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Reads the triangles and quadrilaterals of a gmsh mesh file (any version that gmsh reads) in the x-y plane. Physical
/// groups of surfaces are regions (`rock` where there is none). Physical groups of curves on the outer boundary are
/// sides (`boundary` where there is none), those inside are fractures, directed as the first of their lines in the
/// file. Throws InputError, with `origin`, for files that cannot be read, other elements than three-node triangles and
/// four-node quadrilaterals, nodes off the plane, cells in two groups, and curve groups that branch, close, fall apart,
/// leave the cells' edges, or lie partly inside and partly on the boundary.
RawMesh read_msh(const std::string& file, const Origin& origin = {});

}  // namespace sprekk
