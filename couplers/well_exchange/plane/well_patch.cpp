#include "couplers/well_exchange/plane/well_patch.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "framework/invariants.hpp"

namespace sprekk::couplers {
namespace {

constexpr int most_layers = 8;  // Peaceman's radius to 1.5e-3, the index to 4e-4

/// Whether each node lies on no side and no wall.
std::vector<char> inner_nodes(const Mesh& mesh) {
  std::vector<char> inner(mesh.node_count(), 1);
  for (int f = 0; f < mesh.face_count(); ++f)
    if (mesh.face_cells[f][1] == none)
      for (const int node : mesh.face_nodes[f]) inner[node] = 0;
  return inner;
}

bool is_inside(const Mesh& mesh, const std::vector<char>& inner, int cell) {
  for (const int node : mesh.cell_nodes[cell])
    if (!inner[node]) return false;
  return true;
}

/// The cells whose balances are solved: those around a source, layer by layer, as long as none touches a side.
std::set<int> patch(const Mesh& mesh, const PointSource& source) {
  const std::vector<char> inner = inner_nodes(mesh);
  std::set<int> cells;
  for (const auto& [cell, share] : source.shares) {
    if (!is_inside(mesh, inner, cell)) return {};
    cells.insert(cell);
  }
  for (int layer = 0; layer < most_layers; ++layer) {
    std::set<int> more = cells;
    for (const int cell : cells)
      for (const int node : mesh.cell_nodes[cell])
        for (const int other : mesh.node_cells[node]) {
          if (!is_inside(mesh, inner, other)) return cells;
          more.insert(other);
        }
    cells = std::move(more);
  }
  return cells;
}

}  // namespace

std::vector<char> inner_cells(const Mesh& mesh) {
  const std::vector<char> inner = inner_nodes(mesh);
  std::vector<char> cells(mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c) cells[c] = is_inside(mesh, inner, c);
  return cells;
}

WellPatch::WellPatch(const Mesh& mesh, const MatrixFluxes& fluxes, const PointSource& source, const Tensor& mobility)
    : size_(std::sqrt(mobility.determinant())) {
  SPREKK_EXPECT(size_ > 0, size_);
  const std::set<int> cells = patch(mesh, source);
  if (cells.empty()) return;
  std::vector<char> nodes(mesh.node_count(), 0);
  std::vector<int> place(mesh.cell_count(), none);
  for (const int cell : cells) {
    place[cell] = static_cast<int>(cells_.size());
    cells_.push_back(cell);
    areas_.push_back(mesh.cell_measure[cell]);
    for (const int node : mesh.cell_nodes[cell]) nodes[node] = 1;
  }
  for (const auto& [cell, share] : source.shares) source_.emplace_back(place[cell], share);
  const FluxOperators operators = fluxes.fluxes_around(nodes, mobility);
  if (operators.faces.flux.rows() > 0) throw std::invalid_argument("its discretization has unknowns on faces");
  if (operators.limited[0].cell.rows() > 0) throw std::invalid_argument("its fluxes are not linear in the pressures");

  const Tensor inverse = size_ * mobility.inverse();
  for (const int cell : cells)
    for (const int face : mesh.cell_faces[cell]) {
      const double sign = mesh.face_cells[face][0] == cell ? 1 : -1;
      for (SparseMatrix::InnerIterator entry(operators.flux_cell, face); entry; ++entry) {
        const int other = static_cast<int>(entry.col());
        if (place[other] != none) {
          entries_.emplace_back(place[cell], place[other], sign * entry.value());
        } else if (entry.value() != 0) {
          const Point x = mesh.cell_center[other] - source.at;
          outside_.push_back({place[cell], sign * entry.value(), std::sqrt(x.dot(inverse * x))});
        }
      }
    }
}

/// The balances sqrt(det M) A decay p + outflow(p) = 2 pi sqrt(det M) share at the source and 0 elsewhere.
template <class Source>
double WellPatch::pressure(double decay, const Source& source) const {
  SPREKK_EXPECT(!is_empty());
  const int count = static_cast<int>(cells_.size());
  Vector right = Vector::Zero(count);
  for (const auto& [cell, share] : source_) right[cell] += share * (2 * std::numbers::pi * size_);
  for (const Outside& each : outside_) right[each.row] -= each.weight * source(each.distance);
  std::vector<Triplet> entries = entries_;
  for (int i = 0; i < count; ++i) entries.emplace_back(i, i, size_ * areas_[i] * decay);
  Eigen::SparseMatrix<double> system(count, count);
  system.setFromTriplets(entries.begin(), entries.end());
  const bool is_regular = solver_.factorize(system);
  SPREKK_ASSERT(is_regular, count);
  const Vector pressure = solver_.solve(right);
  double at_point = 0;
  for (const auto& [cell, share] : source_) at_point += share * pressure[cell];
  return at_point;
}

double WellPatch::steady_pressure() const {
  return pressure(0, [](double distance) { return -std::log(distance); });
}

double WellPatch::transformed_pressure(double decay) const {
  SPREKK_EXPECT(decay > 0, decay);
  const double root = std::sqrt(decay);
  return pressure(decay, [root](double distance) { return std::cyl_bessel_k(0.0, distance * root); });
}

}  // namespace sprekk::couplers
