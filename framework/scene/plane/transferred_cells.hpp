// Values of cells on a mesh that has changed.
#pragma once

#include "framework/field/field.hpp"
#include "framework/field/known_within_cells.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk {

/// The accepted values of a field on cells, on the new mesh. Kept cells keep theirs to the bit. Others get, for
/// amounts, the sum of their shares by area. For densities they get the integral over the new cell, divided by its
/// area, of
///   old value of j + gradient of j · (x − centre of j),
/// with j the old cell at x: Eq. 17 of the paper has no gradients, and smooths what varies from cell to cell. Both keep
/// the integral over the mesh. The gradient is that of the linear function which fits the cells that have a node in
/// common with j, and the values at faces that touch j, where they are known, by least squares with weights
/// 1/distance^2 (nodes on the walls of a fracture belong to one side). It is made smaller where needed so that no
/// corner of j gets a value outside of all these (Barth and Jespersen, AIAA 89-0366, 1989). Where the pieces of an old
/// cell are known, densities vary in it as they do, with their weights.
Vector transferred_cells(const Field& old, const MeshChange& change, const Mesh& old_mesh, const Mesh& new_mesh,
                         const KnownWithinCells& known = {});

}  // namespace sprekk
