#include "components/poromechanics/fem/tips_of_faces.hpp"

#include <algorithm>

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

bool is_at_tip(const Mesh& mesh, const std::vector<int>& tips, int cell) {
  return std::ranges::any_of(mesh.cell_faces[cell], [&](int face) { return tips[face] != none; });
}

std::vector<int> groups_at_tips(const Mesh& mesh, const std::vector<int>& tips) {
  std::vector<int> groups(mesh.face_count(), none), cells;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    if (!is_at_tip(mesh, tips, c)) continue;
    cells.push_back(c);
    for (const int face : mesh.cell_faces[c]) groups[face] = face;
  }
  // Each group takes the least of its numbers: cell by cell, until nothing changes.
  for (bool changes = true; changes;) {
    changes = false;
    for (const int c : cells) {
      int least = mesh.face_count();
      for (const int face : mesh.cell_faces[c]) least = std::min(least, groups[face]);
      for (const int face : mesh.cell_faces[c]) {
        changes = changes || groups[face] != least;
        groups[face] = least;
      }
    }
  }
  return groups;
}

std::array<double, 2> means_of_ends(const Mesh& mesh, const std::vector<int>& tips, int face) {
  const int tip = tips.empty() ? none : tips[face];
  if (tip == none) return {1.0 / 2, 1.0 / 2};
  // At the part s of the face from the tip the functions are 1 − sqrt(s) and sqrt(s).
  if (mesh.face_nodes[face][0] == tip) return {1.0 / 3, 2.0 / 3};
  return {2.0 / 3, 1.0 / 3};
}

}  // namespace sprekk::poromechanics
