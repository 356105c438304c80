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
    for (const auto& [r, sign] : outflows_.at(cell, ridges[j])) factors.emplace_back(r, sign * factor);
  }
  return factors;
}

}  // namespace sprekk::fracture_flow
