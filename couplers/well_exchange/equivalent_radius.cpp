#include "couplers/well_exchange/equivalent_radius.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SparseLU>
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

/// The cells whose balances are solved: those around a cell, layer by layer, as long as none touches a side.
std::set<int> patch(const Mesh& mesh, int middle) {
  const std::vector<char> inner = inner_nodes(mesh);
  if (!is_inside(mesh, inner, middle)) return {};
  std::set<int> cells = {middle};
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

std::optional<double> equivalent_radius(const Mesh& mesh, const MatrixFluxes& fluxes, int middle,
                                        const Tensor& mobility) {
  const double size = std::sqrt(mobility.determinant());
  SPREKK_EXPECT(size > 0 && is_index(middle, mesh.cell_count()), size, middle);
  const std::set<int> cells = patch(mesh, middle);
  if (cells.empty()) return std::nullopt;
  std::vector<char> nodes(mesh.node_count(), 0);
  std::vector<int> place(mesh.cell_count(), none);
  int count = 0;
  for (const int cell : cells) {
    place[cell] = count++;
    for (const int node : mesh.cell_nodes[cell]) nodes[node] = 1;
  }
  const FluxOperators operators = fluxes.fluxes_around(nodes, mobility);
  if (operators.faces.flux.rows() > 0) throw std::invalid_argument("its discretization has unknowns on faces");
  if (operators.limited[0].cell.rows() > 0) throw std::invalid_argument("its fluxes are not linear in the pressures");

  const double unit = 2 * std::numbers::pi * size;
  const Tensor inverse = size * mobility.inverse();
  const auto source = [&](int cell) {  // the pressure of a unit rate times `unit`
    const Point x = mesh.cell_center[cell] - mesh.cell_center[middle];
    return -0.5 * std::log(x.dot(inverse * x));
  };
  std::vector<Triplet> entries;
  Vector right = Vector::Zero(count);
  right[place[middle]] = unit;
  for (const int cell : cells)
    for (const int face : mesh.cell_faces[cell]) {
      const double sign = mesh.face_cells[face][0] == cell ? 1 : -1;
      for (SparseMatrix::InnerIterator entry(operators.flux_cell, face); entry; ++entry) {
        const int other = static_cast<int>(entry.col());
        if (place[other] != none)
          entries.emplace_back(place[cell], place[other], sign * entry.value());
        else if (entry.value() != 0)
          right[place[cell]] -= sign * entry.value() * source(other);
      }
    }
  Eigen::SparseMatrix<double> system(count, count);
  system.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(system);
  SPREKK_ASSERT(solver.info() == Eigen::Success, count);
  const Vector pressure = solver.solve(right);
  return std::exp(-pressure[place[middle]]);
}

double radius_of_bore_hole(double radius, const Tensor& mobility) {
  const Point values = Eigen::SelfAdjointEigenSolver<Tensor>(mobility).eigenvalues();
  const double root = std::sqrt(std::sqrt(values[1] / values[0]));
  return radius * (root + 1 / root) / 2;
}

}  // namespace sprekk::couplers
