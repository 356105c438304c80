#include "components/poromechanics/fem/cell_stiffness.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "framework/dense/cholesky.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

namespace {

/// The divergence of (x, y) of each function at a point.
Eigen::RowVectorXd divergence(const CellPoint& point, int functions) {
  Eigen::RowVectorXd row(dimension * functions);
  for (int i = 0; i < functions; ++i) row.segment<dimension>(dimension * i) = point.gradient.col(i).transpose();
  return row;
}

/// The strain (xx, yy, 2 xy) of (x, y) of each function at a point.
Eigen::Matrix3Xd strain(const CellPoint& point, int functions) {
  Eigen::Matrix3Xd rows(3, dimension * functions);
  for (int i = 0; i < functions; ++i) {
    const double dx = point.gradient(0, i), dy = point.gradient(1, i);
    rows.block<3, 2>(0, 2 * i) << dx, 0, 0, dy, dy, dx;
  }
  return rows;
}

}  // namespace

CellStiffness cell_stiffness(const std::vector<CellPoint>& points, const Stiffness& stiffness, ElementOrder order) {
  SPREKK_EXPECT(!points.empty());
  const bool is_second = order == ElementOrder::second;
  const int all = static_cast<int>(points.front().value.size()), functions = is_second ? all : all - 1;
  const int unknowns = dimension * (all - 1), columns = dimension * functions;

  // Moments of the divergence with 1, x and y, from which its projection follows.
  double area = 0;
  Point middle = Point::Zero();
  for (const CellPoint& point : points) {
    area += point.weight;
    middle += point.weight * point.x;
  }
  middle /= area;
  const int terms = is_second ? 1 + dimension : 1;
  const auto basis = [&](const CellPoint& point) {
    Eigen::VectorXd value(terms);
    value[0] = 1;
    if (is_second) value.tail<dimension>() = (point.x - middle) / std::sqrt(area);
    return value;
  };
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(terms, terms), moments = Eigen::MatrixXd::Zero(terms, columns);
  for (const CellPoint& point : points) {
    const Eigen::VectorXd value = basis(point);
    mass += point.weight * value * value.transpose();
    moments += point.weight * value * divergence(point, functions);
  }
  const Eigen::MatrixXd projection = DenseCholesky(mass).solve_columns(moments);

  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(columns, columns);
  for (const CellPoint& point : points) {
    Eigen::Matrix3Xd projected = strain(point, functions);
    const Eigen::RowVectorXd correction =
        (basis(point).transpose() * projection - divergence(point, functions)) / dimension;
    for (int k = 0; k < dimension; ++k) projected.row(k) += correction;
    forces += point.weight * projected.transpose() * stiffness * projected;
  }
  if (!is_second) return {std::move(forces), Eigen::Matrix2Xd::Zero(dimension, unknowns)};

  const auto interior = forces.bottomRightCorner<dimension, dimension>();
  const Eigen::Matrix2Xd along = forces.bottomLeftCorner(dimension, unknowns);
  CellStiffness result;
  result.of_interior = -Tensor(interior).llt().solve(along);
  result.of_unknowns = forces.topLeftCorner(unknowns, unknowns) + along.transpose() * result.of_interior;
  return result;
}

}  // namespace sprekk::poromechanics
