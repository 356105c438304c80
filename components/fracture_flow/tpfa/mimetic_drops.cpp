#include "components/fracture_flow/tpfa/mimetic_drops.hpp"

#include <algorithm>

#include "framework/invariants.hpp"
#include "framework/mesh/ridge_distance.hpp"

namespace sprekk::fracture_flow {

double MimeticDrops::least_kept(int cell, int ridge) const {
  if (of_cell_.empty() || of_cell_[cell].isZero(0)) return 0;
  const FractureCell& of = mesh_->fracture_cells[cell];
  const auto junctions =
      std::ranges::count_if(of.ridges, [&](int other) { return mesh_->ridges[other].kind == Ridge::Kind::junction; });
  const double beside = distance_to_ridge(*mesh_, cell, ridge) * mesh_->ridges[ridge].measure / of.measure;
  return 1 - 1 / (static_cast<double>(junctions) * (1 + beside));
}

Eigen::MatrixXd MimeticDrops::drops(const Mesh& mesh, int cell) const {
  const FaceRidges& ridges = mesh.fracture_cells[cell].ridges;
  const auto count = static_cast<Eigen::Index>(ridges.size());
  Eigen::MatrixXd drops = of_cell_.empty() ? Eigen::MatrixXd::Zero(count, count) : of_cell_[cell];
  for (Eigen::Index k = 0; k < count; ++k) {
    const int ridge = ridges[static_cast<int>(k)];
    drops(k, k) += distance_to_ridge(mesh, cell, ridge) / mesh.ridges[ridge].measure;
  }
  return drops;
}

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
