#include "framework/meshing/conforming/face_group.hpp"

namespace sprekk {

RawMesh::Fracture fracture_of(const FaceGroup& group) { return fracture_with(group.name, group.faces); }

}  // namespace sprekk
