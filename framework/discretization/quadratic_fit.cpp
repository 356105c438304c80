#include "framework/discretization/quadratic_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "framework/dense/least_squares.hpp"
#include "framework/discretization/principal_axes.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/corner_weights.hpp"
#include "framework/mesh/search/distances.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

constexpr int coefficients = (dimension + 1) * (dimension + 2) / 2;
// A monomial is left out where, at the cells, less than this share of it is independent of those before it.
constexpr double independent = 0.1;

/// Whether the line from one point to another crosses a fracture cell.
bool crosses(const Mesh& mesh, int cell, const Point& from, const Point& to) {
  const FractureCell& fracture = mesh.fracture_cells[cell];
  const double before = (from - fracture.center).dot(fracture.normal),
               after = (to - fracture.center).dot(fracture.normal);
  if (before * after >= 0) return false;
  const Point crossing = from + (to - from) * (before / (before - after));
  // With room, since lines between centres of rectangles pass through nodes.
  if (dimension == 2) return (crossing - fracture.center).norm() <= fracture.measure / 2 * (1 + rounding::far_above);
  return distance_to_fracture_cell(mesh, cell, crossing) <= fracture.size() / 2 * rounding::far_above;
}

/// Adds the cells that share a node with one of `cells`, are of the region of `home`, and are seen from its centre.
std::set<int> with_neighbours(const Mesh& mesh, int home, const std::set<int>& cells) {
  std::set<int> candidates, walls;
  for (const int cell : cells)
    for (const int node : mesh.cell_nodes[cell])
      for (const int other : mesh.node_cells[node])
        if (mesh.cell_region[other] == mesh.cell_region[home]) candidates.insert(other);
  for (const int cell : candidates)
    for (const int face : mesh.cell_faces[cell])
      if (mesh.face_fracture_cell[face] != none) walls.insert(mesh.face_fracture_cell[face]);
  std::set<int> seen = cells;
  for (const int cell : candidates) {
    bool is_seen = true;
    for (const int wall : walls)
      is_seen = is_seen && !crosses(mesh, wall, mesh.cell_center[home], mesh.cell_center[cell]);
    if (is_seen) seen.insert(cell);
  }
  return seen;
}

/// The cells of the fit at a node of `home`: those around it, and where these are few those next to them.
std::set<int> around_node(const Mesh& mesh, int home, int node) {
  std::set<int> cells = {home};
  for (const int cell : with_neighbours(mesh, home, cells))
    if (std::ranges::count(mesh.cell_nodes[cell], node) > 0) cells.insert(cell);
  constexpr int rings = 2;  // of neighbours, where the cells around the corner are too few for a fit
  for (int ring = 0; ring < rings && cells.size() < 2 * coefficients; ++ring)
    cells = with_neighbours(mesh, home, cells);
  return cells;
}

/// The monomials of degree two and less of an offset, the constant first.
Eigen::Matrix<double, 1, coefficients> monomials(const Point& offset) {
  Eigen::Matrix<double, 1, coefficients> row;
  row[0] = 1;
  row.segment<dimension>(1) = offset;
  int next = 1 + dimension;
  for (int i = 0; i < dimension; ++i)
    for (int k = i; k < dimension; ++k) row[next++] = offset[i] * offset[k];
  return row;
}

/// The directions in which centres lie farthest and least apart, as columns, the former first: in a strip of cells,
/// along it and across. So what is left out of the polynomial does not depend on how the scene is turned.
Tensor along_and_across(const std::vector<Point>& centres) {
  Point mean = Point::Zero();
  for (const Point& centre : centres) mean += centre / static_cast<double>(centres.size());
  Tensor spread = Tensor::Zero();
  for (const Point& centre : centres) spread += (centre - mean) * (centre - mean).transpose();
  return principal_axes(spread).axes.rowwise().reverse();
}

/// The columns that are independent of those before them, in their order.
Eigen::MatrixXd independent_columns(const Eigen::MatrixXd& all) {
  Eigen::MatrixXd kept(all.rows(), 0);
  for (Eigen::Index k = 0; k < all.cols(); ++k) {
    Eigen::VectorXd left = all.col(k);
    if (kept.cols() > 0) left -= kept * LeastSquares(kept).solve(left);
    if (left.norm() <= independent * all.col(k).norm()) continue;
    kept.conservativeResize(Eigen::NoChange, kept.cols() + 1);
    kept.col(kept.cols() - 1) = all.col(k);
  }
  return kept;
}

/// The weights of the fit to some cells, at x. `size`: of one of them, m.
void add_fit(const Mesh& mesh, const std::set<int>& around, const Point& x, double size, double share,
             std::map<int, double>& result) {
  std::vector<Point> offsets;
  for (const int cell : around) offsets.push_back((mesh.cell_center[cell] - x) / size);
  const auto count = static_cast<Eigen::Index>(offsets.size());
  Eigen::VectorXd weights(count);
  for (Eigen::Index i = 0; i < count; ++i) weights[i] = 1 / (1 + offsets[static_cast<std::size_t>(i)].squaredNorm());
  const Tensor turn = along_and_across(offsets).transpose();
  // Minimizes the sum of (weight · (polynomial at the centre − value))²; the value at x is the first coefficient.
  Eigen::MatrixXd basis(count, coefficients);
  for (Eigen::Index i = 0; i < count; ++i)
    basis.row(i) = weights[i] * monomials(turn * offsets[static_cast<std::size_t>(i)]);
  const Eigen::MatrixXd inverse = LeastSquares(independent_columns(basis)).pseudo_inverse();
  for (Eigen::Index i = 0; const int cell : around) {
    result[cell] += share * inverse(0, i) * weights[i];
    ++i;
  }
}

}  // namespace

std::vector<std::pair<int, double>> quadratic_fit(const Mesh& mesh, int home, const Point& x) {
  SPREKK_EXPECT(is_finite(x));
  if (home == none) return {};
  std::map<int, double> result;
  for (const auto& [node, share] : corner_weights(mesh, home, x)) {
    double measure = 0;  // of the cells at the node: not that of `home`, which one cell of several may be
    for (const int cell : mesh.node_cells[node])
      measure += mesh.cell_measure[cell] / static_cast<double>(mesh.node_cells[node].size());
    const double size = std::pow(measure, 1.0 / dimension);
    SPREKK_ASSERT(size > 0, home, size);
    add_fit(mesh, around_node(mesh, home, node), x, size, share, result);
  }
  return {result.begin(), result.end()};
}

}  // namespace sprekk
