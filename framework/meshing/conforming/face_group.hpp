// A physical group of faces in a mesh file: of curves in a plane, of surfaces in space.
#pragma once

#include <string>
#include <vector>

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// The faces of a group, in the order of the file.
struct FaceGroup {
  std::string name;
  std::vector<FaceNodes> faces;
};

/// The fracture that a group is: in a plane one line, directed as its first face. Throws InputError for a group that is
/// none.
RawMesh::Fracture fracture_of(const FaceGroup& group);

}  // namespace sprekk
