#include "components/poromechanics/pinned_cells.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <set>

#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_sums.hpp"

namespace sprekk::poromechanics {
namespace {

/// Of directions in which cells are spread around a point, relative to the first: below, they lie on a line or plane.
constexpr double flat = 1e-6;

/// Cells that share a node with those at a node, the nearest first.
std::vector<int> cells_near(const Mesh& mesh, int node) {
  std::set<int> near;
  for (const int at_node : mesh.node_cells[node])
    for (const int corner : mesh.cell_nodes[at_node])
      near.insert(mesh.node_cells[corner].begin(), mesh.node_cells[corner].end());
  std::vector<int> cells(near.begin(), near.end());
  std::ranges::stable_sort(cells, {}, [&](int cell) { return (mesh.cell_center[cell] - mesh.nodes[node]).norm(); });
  return cells;
}

/// The weights w with sum w = 1 and sum w (x_c − x) = 0 and the least sum of (w |x_c − x|)²; empty where none exist.
std::vector<double> linear_weights(const Mesh& mesh, int node, const std::vector<int>& cells) {
  const auto count = static_cast<Eigen::Index>(cells.size());
  const Point& x = mesh.nodes[node];
  const double size = (mesh.cell_center[cells.back()] - x).norm();
  Eigen::MatrixXd moments(dimension + 1, count);  // of w |x_c − x| / size
  Vector distance(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Point arm = (mesh.cell_center[cells[i]] - x) / size;
    distance[i] = arm.norm();
    SPREKK_ASSERT(distance[i] > 0, node, cells[i]);
    moments(0, i) = 1 / distance[i];
    moments.col(i).tail<dimension>() = arm / distance[i];
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(flat);
  decomposition.compute(moments);
  if (decomposition.rank() < dimension + 1) return {};
  const Vector scaled = decomposition.solve(Vector::Unit(dimension + 1, 0));
  std::vector<double> weights;
  for (Eigen::Index i = 0; i < count; ++i) weights.push_back(scaled[i] / distance[i]);
  return weights;
}

}  // namespace

PinnedCells::PinnedCells(const Options& options, const Mesh& mesh) : mesh_(mesh) {
  std::set<int> replaced;
  for (const auto& [name, point] : options.pinned) {
    const int node = pinned_node(point, name, mesh);
    const std::vector<int> cells = cells_near(mesh, node);
    const std::vector<double> weights = linear_weights(mesh, node, cells);
    if (weights.empty())
      throw InputError(point.origin, "the mesh does not determine the displacement of the pinned point '" + name + "'",
                       "all cells near it are in a row", "refine the mesh, or take poromechanics/fem");
    for (int k = 0; k < dimension; ++k) {
      if (!point.displacement_along[k]) continue;
      const Place place{mesh.nodes[node], mesh.cell_region[mesh.node_cells[node][0]], 0};
      Equation equation{&*point.displacement_along[k], place, none, {}};
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const int row = dimension * cells[i] + k;
        equation.weights.emplace_back(row, weights[i]);
        if (equation.row == none && replaced.insert(row).second) equation.row = row;
      }
      if (equation.row == none)
        throw InputError(point.origin, "the pinned point '" + name + "' is too near to others",
                         "no cell near it is left that may bear its force", "refine the mesh, or move it away");
      equations_.push_back(std::move(equation));
    }
  }
}

SparseMatrix PinnedCells::hold(const SparseMatrix& balances) {
  if (is_empty()) return balances;
  SparseMatrix equations(balances.rows(), balances.cols());
  std::vector<Triplet> entries;
  for (Equation& equation : equations_) {
    if (!is_owned(mesh_, Location::cell, equation.row / dimension)) continue;
    equation.scale = std::abs(balances.coeff(equation.row, equation.row));
    SPREKK_ASSERT(equation.scale > 0, equation.row);
    for (const auto& [value, weight] : equation.weights)
      entries.emplace_back(equation.row, value, equation.scale * weight);
  }
  equations.setFromTriplets(entries.begin(), entries.end());
  return clear(balances) + equations;
}

SparseMatrix PinnedCells::clear(const SparseMatrix& balances) const {
  if (is_empty()) return balances;
  std::vector<char> keep(balances.rows(), 1);
  for (const Equation& equation : equations_) keep[equation.row] = 0;
  return keep_rows(balances, keep);
}

void PinnedCells::give(const Vector& displacements, Vector& constants) const {
  SPREKK_EXPECT(displacements.size() == static_cast<Eigen::Index>(equations_.size()), displacements.size());
  for (std::size_t i = 0; i < equations_.size(); ++i)
    constants[equations_[i].row] = -equations_[i].scale * displacements[static_cast<Eigen::Index>(i)];
}

Vector PinnedCells::displacements(const StepTime& step) const {
  Vector given(static_cast<Eigen::Index>(equations_.size()));
  for (std::size_t i = 0; i < equations_.size(); ++i)
    given[static_cast<Eigen::Index>(i)] = value_in_step(*equations_[i].given, equations_[i].place, step);
  return given;
}

}  // namespace sprekk::poromechanics
