// From a mesh of cells to the mixed-dimensional mesh: split along the fractures, with all topology and geometry.
#pragma once

#include <cstdint>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Splits a mesh along its fractures. The cells at a fracture node fall into groups that are connected through faces
/// that are no fracture; each group gets its own copy of the node. So a tip in the rock is not split, and the end of a
/// fracture on the outer boundary is. The first copy of a node keeps the number of the node; further copies come behind
/// all nodes of the input. Cells keep their order. The plus side of a fracture in a plane is to the left of its chain.
/// What fractures share, a node in a plane and an edge in space, becomes a Junction. Each call gives the mesh a new
/// version.
///
/// Throws InputError for
/// - cells that are degenerate, not convex or overlap, and three cells at a face;
/// - outer faces without a side, and inner faces with one;
/// - fractures that have no face, leave the faces of the mesh, meet themselves, share a face, meet on the outer
///   boundary, or touch the outer boundary other than with an end.
Mesh build_mesh(const RawMesh& raw);

/// The mesh with the walls closed again, so that build_mesh(to_raw_mesh(mesh)) has the same cells. `merged`,
/// if not null, becomes the raw node of each node of the mesh.
RawMesh to_raw_mesh(const Mesh& mesh, std::vector<int>* merged = nullptr);

/// A version number that no mesh of this process has had.
std::uint64_t next_mesh_version();

}  // namespace sprekk
