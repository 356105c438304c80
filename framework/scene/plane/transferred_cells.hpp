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
/// with j the old cell at x: Eq. 17 of the paper has no gradients, which smooths the field. Both conserve the integral
/// over the mesh. The gradient is that of the linear function which fits the cells that have a node in common with j,
/// and the values at faces that touch j, where they are known, by least squares with weights 1/distance^2 (nodes on the
/// walls of a fracture belong to one side). It is reduced so that no corner of j gets a value outside of the range of
/// these (Barth and Jespersen, AIAA 89-0366, 1989). If the values of pieces of an old cell are given, they replace this
/// linear function, with their weights.
Vector transferred_cells(const Field& old, const MeshChange& change, const Mesh& old_mesh, const Mesh& new_mesh,
                         const KnownWithinCells& known = {});

}  // namespace sprekk
