// Transfer of values on nodes and faces to another mesh.
#pragma once

#include "framework/field/field.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk {

/// The accepted values of a field on nodes or faces, on the new mesh. Entities of kept cells keep their values to the
/// bit. A new entity gets the value of the old field at its place (weights_in_cell, exact for linear fields). It is
/// taken in the old cell that contains the place and overlaps the new cells of the entity, so values stay on their side
/// of a fracture.
Vector transferred_in_cells(const Field& old, const MeshChange& change, const Mesh& old_mesh, const Mesh& new_mesh);

}  // namespace sprekk
