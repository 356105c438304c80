#include "components/poromechanics/fem/tips_of_faces.hpp"

#include <algorithm>

namespace sprekk::poromechanics {

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

}  // namespace sprekk::poromechanics
