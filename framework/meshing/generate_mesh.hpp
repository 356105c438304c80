// The mesh of a scene.
#pragma once

#include <string>
#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// Makes the mesh of a scene: validates the geometry, triangulates it (or reads the file), avoids single cells in
/// corners, distorts the mesh if asked, and splits it along the fractures (build_mesh).
/// The same input gives the same mesh, apart from its version. Throws InputError for wrong input and
/// std::runtime_error when the mesh generator fails.
Mesh generate_mesh(const Geometry& geometry, const MeshOptions& options);

/// The names of regions, sides and fractures of the mesh of a geometry, in their order.
struct MeshNames {
  std::vector<std::string> regions, sides, fractures;
  std::vector<std::string> notes;  ///< what the user of a mesh file may not expect
};
MeshNames mesh_names(const Geometry& geometry);

}  // namespace sprekk
