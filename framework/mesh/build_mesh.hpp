// From a plane mesh to the mixed-dimensional mesh: split along the fractures, with all topology and geometry.
#pragma once

#include <cstdint>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// The cells at a fracture node fall into groups that are connected through edges that are no fracture; each group
/// gets its own copy of the node. So a tip in the rock is not split, a fracture's end on the outer boundary is.
/// The first copy keeps the node's place, further ones come behind all nodes of the input. Cells keep their order.
/// The plus side of a fracture is to the left of its chain. Where fractures share a node, it becomes a Junction. A new
/// version is given at every call.
/// Throws InputError for degenerate cells, quadrilaterals that are not convex, overlaps, three cells at an edge, outer
/// edges without a side, inner edges with one, and fractures that have no edge, leave the edges, repeat a node, share
/// an edge, meet on the outer boundary, or touch it other than with an end.
Mesh build_mesh(const RawMesh& raw);

/// The plane mesh with the walls closed again, so that build_mesh(to_raw_mesh(mesh)) has the same cells. `merged`,
/// if not null, becomes the raw node of each node of the mesh.
RawMesh to_raw_mesh(const Mesh& mesh, std::vector<int>* merged = nullptr);

/// A number that no mesh of this process has had.
std::uint64_t next_mesh_version();

}  // namespace sprekk
