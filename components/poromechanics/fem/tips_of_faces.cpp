#include "components/poromechanics/fem/tips_of_faces.hpp"

namespace sprekk::poromechanics {

std::vector<int> tips_of_faces(const Mesh& mesh) {
  std::vector<char> is_tip(mesh.node_count(), 0);
  for (const FracturePoint& point : mesh.fracture_points) {
    if (point.kind != FracturePoint::Kind::tip) continue;
    const auto& walls = mesh.fracture_cells[point.cells[0]].faces;
    for (const int node : mesh.face_nodes[walls[0]])
      for (const int other : mesh.face_nodes[walls[1]])
        if (node == other && mesh.nodes[node] == point.position) is_tip[node] = 1;
  }
  std::vector<int> tips(mesh.face_count(), none);
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto& [from, to] = mesh.face_nodes[f];
    if (is_tip[from] != is_tip[to]) tips[f] = is_tip[from] ? from : to;
  }
  return tips;
}

std::array<double, 2> means_of_ends(const Mesh& mesh, const std::vector<int>& tips, int face) {
  const int tip = tips.empty() ? none : tips[face];
  if (tip == none) return {1.0 / 2, 1.0 / 2};
  // At the part s of the face from the tip the functions are 1 − sqrt(s) and sqrt(s).
  if (mesh.face_nodes[face][0] == tip) return {1.0 / 3, 2.0 / 3};
  return {2.0 / 3, 1.0 / 3};
}

}  // namespace sprekk::poromechanics
