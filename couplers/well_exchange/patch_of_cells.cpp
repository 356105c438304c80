#include "couplers/well_exchange/patch_of_cells.hpp"

#include <map>
#include <stdexcept>
#include <utility>

#include "framework/invariants.hpp"

namespace sprekk::couplers {

PatchOfCells::PatchOfCells(const Mesh& mesh, const MatrixFluxes& fluxes, std::vector<int> cells, const Tensor& mobility)
    : cells_(std::move(cells)) {
  std::vector<char> nodes(mesh.node_count(), 0);
  std::vector<int> place(mesh.cell_count(), none);
  for (const int cell : cells_) {
    place[cell] = static_cast<int>(measures_.size());
    measures_.push_back(mesh.cell_measure[cell]);
    for (const int node : mesh.cell_nodes[cell]) nodes[node] = 1;
  }
  const FluxOperators operators = fluxes.fluxes_around(nodes, mobility);
  if (operators.faces.flux.rows() > 0) throw std::invalid_argument("its discretization has unknowns on faces");
  if (operators.limited[0].cell.rows() > 0) throw std::invalid_argument("its fluxes are not linear in the pressures");
  std::map<int, int> points;
  for (const int cell : cells_)
    for (const int face : mesh.cell_faces[cell]) {
      const double sign = mesh.face_cells[face][0] == cell ? 1 : -1;
      for (SparseMatrix::InnerIterator entry(operators.flux_cell, face); entry; ++entry) {
        const int other = static_cast<int>(entry.col());
        if (place[other] != none) {
          entries_.emplace_back(place[cell], place[other], sign * entry.value());
        } else if (entry.value() != 0) {
          const auto [point, is_new] = points.try_emplace(other, static_cast<int>(points_.size()));
          if (is_new) points_.push_back(mesh.cell_center[other]);
          outside_.push_back({place[cell], point->second, sign * entry.value()});
        }
      }
    }
}

Vector PatchOfCells::solve(double storage, const Vector& supply,
                           const std::function<double(const Point&)>& around) const {
  const int count = static_cast<int>(cells_.size());
  SPREKK_EXPECT(count > 0 && supply.size() == count, count, supply.size());
  std::vector<double> pressures;
  for (const Point& point : points_) pressures.push_back(around(point));
  Vector right = supply;
  for (const Outside& each : outside_) right[each.row] -= each.weight * pressures[each.point];
  std::vector<Triplet> entries = entries_;
  for (int i = 0; i < count; ++i) entries.emplace_back(i, i, storage * measures_[i]);
  Eigen::SparseMatrix<double> system(count, count);
  system.setFromTriplets(entries.begin(), entries.end());
  const bool is_regular = solver_.factorize(system);
  SPREKK_ASSERT(is_regular, count);
  return solver_.solve(right);
}

}  // namespace sprekk::couplers
