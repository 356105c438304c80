#include "components/poromechanics/fem/tips_of_faces.hpp"

namespace sprekk::poromechanics {

std::vector<int> tips_of_faces(const Mesh& mesh) { return std::vector<int>(mesh.face_count(), none); }

}  // namespace sprekk::poromechanics
