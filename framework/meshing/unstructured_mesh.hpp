// Triangles or tetrahedra of varying size in a box, made by gmsh.
#pragma once

#include "framework/mesh/raw_mesh.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// Frontal-Delaunay triangles (gmsh's algorithm 6) with the edge lengths of SizeField; fractures and the edges of
/// polygons are edges of the mesh. The geometry must be valid (validate_geometry). Throws std::runtime_error if gmsh
/// fails. In space tetrahedra (gmsh's algorithm 1), between fractures and the planes that bound regions.
RawMesh unstructured_mesh(const Geometry& geometry, const MeshOptions& options);

}  // namespace sprekk
