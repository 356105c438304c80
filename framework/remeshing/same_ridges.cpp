#include "framework/remeshing/same_ridges.hpp"

#include <array>
#include <map>

#include "framework/invariants.hpp"

namespace sprekk {

std::vector<int> same_ridges(const Mesh& old, const Mesh& mesh, const std::vector<int>& old_cell) {
  SPREKK_EXPECT(static_cast<int>(old_cell.size()) == mesh.fracture_cell_count(), old_cell.size());
  std::vector<int> same(mesh.ridges.size(), none);
  for (int now = 0; now < mesh.fracture_cell_count(); ++now) {
    if (old_cell[now] == none) continue;
    for (const int end : {0, 1})
      same[mesh.fracture_cells[now].ridges[end]] = old.fracture_cells[old_cell[now]].ridges[end];
  }
  if (mesh.junctions.empty()) return same;
  std::map<std::array<int, 2>, int> old_point;  // by the old cells that meet there
  for (std::size_t point = 0; point < old.ridges.size(); ++point) {
    const auto& cells = old.ridges[point].cells;
    if (cells.size() == 2) old_point[{cells[0], cells[1]}] = static_cast<int>(point);
  }
  for (const Junction& junction : mesh.junctions) {
    for (const int point : junction.ridges) {
      const auto& cells = mesh.ridges[point].cells;
      const auto found = old_point.find({old_cell[cells[0]], old_cell[cells[1]]});
      same[point] = found == old_point.end() ? none : found->second;
    }
  }
  return same;
}

}  // namespace sprekk
