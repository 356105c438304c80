// Jumps of fracture cells after a change of the mesh.
#pragma once

#include "framework/mesh/mesh_change.hpp"
#include "framework/types.hpp"

namespace sprekk::contact {

/// The jumps of all fracture cells of a mesh, m.
struct JumpsOnMesh {
  const Mesh& mesh;
  const Vector& jump;  ///< (normal, tangential) of each fracture cell
};

/// The jumps on the new mesh: kept cells keep them, new cells have none, and cells that replace old ones get the volume
/// of the jumps of these. `carried`: the jumps after the transfer of fields.
Vector jump_on_changed_mesh(const MeshChange& change, const JumpsOnMesh& carried, const JumpsOnMesh& before);

}  // namespace sprekk::contact
