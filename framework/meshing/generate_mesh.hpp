// The mesh of a scene.
#pragma once

#include <string>
#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// Validates, triangulates (or reads the file), avoids single cells in corners, distorts if asked, and builds.
/// The same input gives the same mesh, apart from its version. Throws InputError for wrong input and
/// std::runtime_error when the mesh generator fails.
Mesh generate_mesh(const Geometry& geometry, const MeshOptions& options);

/// What a mesh of the geometry will call its parts, in their order, without meshing; a file is read.
struct MeshNames {
  std::vector<std::string> regions, sides, fractures;
};
MeshNames mesh_names(const Geometry& geometry);

}  // namespace sprekk
