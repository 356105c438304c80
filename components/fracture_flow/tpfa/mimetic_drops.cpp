#include "components/fracture_flow/tpfa/mimetic_drops.hpp"

#include <algorithm>

#include "framework/invariants.hpp"

namespace sprekk::fracture_flow {
std::vector<std::pair<int, double>> MimeticDrops::at(int cell, int ridge) const {
  std::vector<std::pair<int, double>> factors;
  if (of_cell_.empty()) return factors;
  const FaceRidges& ridges = mesh_->fracture_cells[cell].ridges;
  const auto is_here = [&](int other) { return mesh_->ridges[other].center == mesh_->ridges[ridge].center; };
  const auto place = std::ranges::find_if(ridges, is_here) - ridges.begin();
  SPREKK_EXPECT(is_index(place, ridges.size()), cell, ridge);
  for (int j = 0; j < static_cast<int>(ridges.size()); ++j) {
    const double factor = of_cell_[cell](place, j);
    if (factor == 0) continue;
    // What flows out at a junction goes to each of the other cells there.
    const int junction = junction_of_ridge_[ridges[j]];
    const std::vector<int> one = {ridges[j]};
    for (const int r : junction == none ? one : mesh_->junctions[junction].ridges) {
      const std::vector<int>& cells = mesh_->ridges[r].cells;
      if (std::ranges::count(cells, cell) > 0) factors.emplace_back(r, cells[0] == cell ? factor : -factor);
    }
  }
  return factors;
}

}  // namespace sprekk::fracture_flow
