#include "components/poromechanics/fem/tips_of_faces.hpp"

namespace sprekk::poromechanics {

std::vector<int> tips_of_faces(const Mesh& mesh) {
  std::vector<char> is_tip(mesh.node_count(), 0);
  for (const Ridge& point : mesh.ridges) {
    if (point.kind != Ridge::Kind::tip) continue;
    const auto& walls = mesh.fracture_cells[point.cells[0]].faces;
    for (const int node : mesh.face_nodes[walls[0]])
      for (const int other : mesh.face_nodes[walls[1]])
        if (node == other && mesh.nodes[node] == point.center) is_tip[node] = 1;
  }
  std::vector<int> tips(mesh.face_count(), none);
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto& [from, to] = mesh.face_nodes[f];
    if (is_tip[from] != is_tip[to]) tips[f] = is_tip[from] ? from : to;
  }
  return tips;
}

}  // namespace sprekk::poromechanics
