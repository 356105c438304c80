// Joins the two sides of a line that a mesh file has cut open.
#pragma once

#include <vector>

#include "framework/mesh/raw_mesh.hpp"
#include "framework/meshing/conforming/face_group.hpp"

namespace sprekk {

/// Gives both sides of a crack the same nodes, so that its group is one of a fracture. gmsh's plug-in "Crack" doubles
/// the nodes and the lines of a group: a group is a crack where each of its lines is an outer edge of the mesh that
/// lies on another one, of no other group. Returns whether there was a crack. The cells are counter-clockwise.
bool glue_cuts(RawMesh& mesh, std::vector<FaceGroup>& groups);

}  // namespace sprekk
