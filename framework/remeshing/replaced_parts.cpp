#include "framework/remeshing/replaced_parts.hpp"

#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk {

void add_replaced_parts(const Mesh& old, const std::vector<int>& replaced, const Mesh& mesh,
                        const std::vector<int>& path, MeshChange& change) {
  SPREKK_EXPECT(replaced.empty() || !path.empty(), replaced.size());
  std::size_t next = 0;
  double way = 0, end_of_path_cell = path.empty() ? 0 : mesh.fracture_cells[path[0]].measure;  // m, from the anchor
  for (const int old_cell : replaced) {
    const double length = old.fracture_cells[old_cell].measure;
    double left = 1;  // share
    while (next + 1 < path.size() && end_of_path_cell < way + (left - rounding::same) * length) {
      const double share = (end_of_path_cell - way) / length;
      if (share > rounding::same) {
        change.replaced_parts.push_back({path[next], old_cell, share, share * length});
        left -= share;
        way = end_of_path_cell;
      }
      end_of_path_cell += mesh.fracture_cells[path[++next]].measure;
    }
    change.replaced_parts.push_back({path[next], old_cell, left, left * length});
    way += left * length;
  }
}

}  // namespace sprekk
