#include "framework/discretization/quadratic_fit.hpp"

#include <cmath>
#include <set>

#include "framework/dense/least_squares.hpp"
#include "framework/dense/symmetric_eigen.hpp"
#include "framework/invariants.hpp"

namespace sprekk {
namespace {

constexpr int coefficients = (dimension + 1) * (dimension + 2) / 2;
// Below this share of a monomial that the ones before it do not make, cells do not tell it apart from them.
constexpr double independent = 0.1;
// Of half the length of a fracture cell: a line that passes its end at less crosses it.
constexpr double grazes = 1e-6;

/// Whether the line from one point to another crosses a fracture cell.
bool crosses(const FractureCell& fracture, const Point& from, const Point& to) {
  const double before = (from - fracture.center).dot(fracture.normal),
               after = (to - fracture.center).dot(fracture.normal);
  if (before * after >= 0) return false;
  const Point crossing = from + (to - from) * (before / (before - after));
  const double radius = std::pow(fracture.measure, 1.0 / (dimension - 1)) / 2;
  return (crossing - fracture.center).norm() <= radius * (1 + grazes);
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
      is_seen = is_seen && !crosses(mesh.fracture_cells[wall], mesh.cell_center[home], mesh.cell_center[cell]);
    if (is_seen) seen.insert(cell);
  }
  return seen;
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

/// The columns that columns before them do not make up, in their order.
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

}  // namespace

std::vector<std::pair<int, double>> quadratic_fit(const Mesh& mesh, int home, const Point& x) {
  SPREKK_EXPECT(is_finite(x));
  if (home == none) return {};
  std::set<int> around = with_neighbours(mesh, home, {home});
  if (around.size() < 2 * coefficients) around = with_neighbours(mesh, home, around);
  const double size = std::pow(mesh.cell_measure[home], 1.0 / dimension);
  SPREKK_ASSERT(size > 0, home, size);
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
  std::vector<std::pair<int, double>> result;
  for (Eigen::Index i = 0; const int cell : around) {
    result.emplace_back(cell, inverse(0, i) * weights[i]);
    ++i;
  }
  return result;
}

}  // namespace sprekk
