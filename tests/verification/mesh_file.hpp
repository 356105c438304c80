// Meshes as files, moved to another place, for scenes whose boxes are not along the axes.
#pragma once

#include <string>

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk::testing {

/// Writes the mesh, each of its nodes x at map · x + shift, as a gmsh file of version 2.2 into the folder of temporary
/// files of tests. Returns the path of the file.
std::string write_msh(const RawMesh& mesh, const Tensor& map, const Point& shift, const std::string& name);

/// The rotation by an angle in degrees.
Tensor turned_by(double degrees);

}  // namespace sprekk::testing
