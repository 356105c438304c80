// Rectangles, whole or cut into triangles with alternating diagonals; in space hexahedra, whole or cut.
#pragma once

#include "framework/mesh/raw_mesh.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// Rectangles of equal size; for triangles they are cut by diagonals whose direction alternates like a chess board
/// ("union jack"). Fractures must lie on grid lines and diagonals, else InputError; cells take the region of their
/// centre. In space hexahedra of equal size; for wedges they are cut by alternating diagonals in x and y, for
/// tetrahedra by alternating diagonals along all axes; fractures must be faces of cells. The geometry must be valid
/// (validate_geometry).
RawMesh structured_mesh(const Geometry& geometry, const MeshOptions& options);

}  // namespace sprekk
