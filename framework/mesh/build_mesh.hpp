// From a plane mesh to the mixed-dimensional mesh: split along the fractures, with all topology and geometry.
#pragma once

#include <cstdint>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Splits a plane mesh along its fractures. The cells at a fracture node fall into groups that are connected through
/// edges that are no fracture; each group gets its own copy of the node. So a tip in the rock is not split, and the end
/// of a fracture on the outer boundary is. The first copy of a node keeps the number of the node; further copies come
/// behind all nodes of the input. Cells keep their order. The plus side of a fracture is to the left of its chain. A
/// node that fractures share becomes a Junction. Each call gives the mesh a new version.
/// Throws InputError for degenerate cells, quadrilaterals that are not convex, overlaps, three cells at an edge, outer
/// edges without a side, inner edges with one, and fractures that have no edge, leave the edges, repeat a node, share
/// an edge, meet on the outer boundary, or touch it other than with an end.
Mesh build_mesh(const RawMesh& raw);

/// The plane mesh with the walls closed again, so that build_mesh(to_raw_mesh(mesh)) has the same cells. `merged`,
/// if not null, becomes the raw node of each node of the mesh.
RawMesh to_raw_mesh(const Mesh& mesh, std::vector<int>* merged = nullptr);

/// A version number that no mesh of this process has had.
std::uint64_t next_mesh_version();

}  // namespace sprekk
