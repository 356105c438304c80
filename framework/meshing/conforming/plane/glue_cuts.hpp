// Joins the two sides of a line that a mesh file has cut open.
#pragma once

#include <vector>

#include "framework/mesh/raw_mesh.hpp"
#include "framework/meshing/conforming/face_group.hpp"

namespace sprekk {

/// Joins the two sides of each crack that gmsh's plug-in "Crack" has cut into the mesh, so that its group of lines is
/// that of a fracture. The plug-in doubles the nodes and lines of a group. So a group is a crack if each of its lines
/// is an outer edge of the mesh at the place of another outer edge, which belongs to no other group. Returns whether
/// there was a crack. The nodes of cells are counter-clockwise.
bool glue_cuts(RawMesh& mesh, std::vector<FaceGroup>& groups);

}  // namespace sprekk
