// Values of cells on a mesh that has changed.
#pragma once

#include "framework/field/field.hpp"
#include "framework/field/linear_pieces.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk {

/// The accepted values of a field on cells, on the new mesh. Kept cells keep theirs to the bit. Others get, for
/// amounts, the sum of their shares by area. For densities they get the integral over the new cell, divided by its
/// area, of
///   old value of j + gradient of j · (x − centre of j),
/// with j the old cell at x: Eq. 17 of the paper has no gradients, and smooths what varies from cell to cell. Both keep
/// the integral over the mesh. The gradient is that of the linear function which fits the cells that have a node in
/// common with j by least squares with weights 1/distance^2 (nodes on the walls of a fracture belong to one side), made
/// smaller where needed so that no corner of j gets a value outside of those of these cells (Barth and Jespersen, AIAA
/// 89-0366, 1989). Where more is known of an old cell, densities vary in it as its pieces do, with their weights.
Vector transferred_cells(const Field& old, const MeshChange& change, const Mesh& old_mesh, const Mesh& new_mesh,
                         const LinearPieces& known = {});

}  // namespace sprekk
