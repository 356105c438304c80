// Removes cells that are connected to the rest of the mesh through one face only.
#pragma once

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Changes the mesh so that no triangle has two edges on the outer boundary or on fractures: one triangle alone in a
/// corner makes the local problems of multi-point schemes singular. (A quadrilateral alone in a corner has two
/// neighbours whose displacements it can continue, and stays.) The inner edge of the triangle is flipped. Where a flip
/// would divide a region, give another triangle two such edges or make a small angle, or where a quadrilateral lies
/// behind the edge, the edge is halved instead: this adds one node and cuts both cells into triangles. A cell that is
/// surrounded by fractures and sides is cut into triangles around its centre. Returns the number of such cells that
/// were removed; a cell that is the whole mesh stays.
int avoid_single_cell_corners(RawMesh& mesh);

}  // namespace sprekk
