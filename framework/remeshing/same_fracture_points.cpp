#include "framework/remeshing/same_fracture_points.hpp"

#include <array>
#include <map>

#include "framework/invariants.hpp"

namespace sprekk {

std::vector<int> same_fracture_points(const Mesh& old, const Mesh& mesh, const std::vector<int>& old_cell) {
  SPREKK_EXPECT(static_cast<int>(old_cell.size()) == mesh.fracture_cell_count(), old_cell.size());
  std::vector<int> same(mesh.fracture_points.size(), none);
  for (int now = 0; now < mesh.fracture_cell_count(); ++now) {
    if (old_cell[now] == none) continue;
    for (const int end : {0, 1})
      same[mesh.fracture_cells[now].points[end]] = old.fracture_cells[old_cell[now]].points[end];
  }
  if (mesh.junctions.empty()) return same;
  std::map<std::array<int, 2>, int> old_point;  // by the old cells that meet there
  for (std::size_t point = 0; point < old.fracture_points.size(); ++point) {
    const auto& cells = old.fracture_points[point].cells;
    if (cells.size() == 2) old_point[{cells[0], cells[1]}] = static_cast<int>(point);
  }
  for (const Junction& junction : mesh.junctions) {
    for (const int point : junction.points) {
      const auto& cells = mesh.fracture_points[point].cells;
      const auto found = old_point.find({old_cell[cells[0]], old_cell[cells[1]]});
      same[point] = found == old_point.end() ? none : found->second;
    }
  }
  return same;
}

}  // namespace sprekk
