// Cells that see the rest of the mesh through one face only.
#pragma once

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Changes the mesh so that no triangle has two edges on the outer boundary or on fractures: one triangle alone in a
/// corner makes the local problems of multi-point schemes singular. (A quadrilateral alone in a corner has two
/// neighbours whose displacements it can continue: those stay.) The triangle's inner edge is flipped; where that
/// would divide a region, lay two such edges on another triangle or give a small angle, or where a quadrilateral
/// lies behind the edge, the edge is halved instead, which adds one node and cuts both cells into triangles. A cell
/// with fractures all around, or fractures and sides, is cut into triangles around its centre. Returns how many cells
/// were cured; one that is the whole mesh stays.
int avoid_single_cell_corners(RawMesh& mesh);

}  // namespace sprekk
