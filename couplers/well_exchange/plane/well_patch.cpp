#include "couplers/well_exchange/plane/well_patch.hpp"

#include <Eigen/LU>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>

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
    : size_(std::sqrt(mobility.determinant())), at_(source.at), inverse_(size_ * mobility.inverse()) {
  SPREKK_EXPECT(size_ > 0, size_);
  const std::set<int> cells = patch(mesh, source);
  if (cells.empty()) return;
  cells_.emplace(mesh, fluxes, std::vector<int>(cells.begin(), cells.end()), mobility);
  for (const auto& [cell, share] : source.shares)
    source_.emplace_back(static_cast<int>(std::distance(cells.begin(), cells.find(cell))), share);
}

/// The balances sqrt(det M) A decay p + outflow(p) = 2 pi sqrt(det M) share at the source and 0 elsewhere.
template <class Source>
double WellPatch::pressure(double decay, const Source& source) const {
  SPREKK_EXPECT(!is_empty());
  Vector supply = Vector::Zero(static_cast<int>(cells_->cells().size()));
  for (const auto& [cell, share] : source_) supply[cell] += share * (2 * std::numbers::pi * size_);
  const Vector pressure = cells_->solve(size_ * decay, supply, [&](const Point& x) {
    const Point away = x - at_;
    return source(std::sqrt(away.dot(inverse_ * away)));
  });
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
