#include "components/poromechanics/fem/cell_stiffness.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "framework/dense/cholesky.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

namespace {

/// The divergence of each component of each function at a point.
Eigen::RowVectorXd divergence(const CellPoint& point, int functions) {
  Eigen::RowVectorXd row(dimension * functions);
  for (int i = 0; i < functions; ++i) row.segment<dimension>(dimension * i) = point.gradient.col(i).transpose();
  return row;
}

/// The strain (strain_of) of each component of each function at a point.
using Strains = Eigen::Matrix<double, symmetric_components, Eigen::Dynamic>;
Strains strain(const CellPoint& point, int functions) {
  Strains rows = Strains::Zero(symmetric_components, dimension * functions);
  for (int i = 0; i < functions; ++i)
    for (int k = 0; k < symmetric_components; ++k) {
      const auto [one, other] = symmetric_axes[k];
      rows(k, dimension * i + one) = point.gradient(other, i);
      rows(k, dimension * i + other) = point.gradient(one, i);
    }
  return rows;
}

}  // namespace

CellStiffness cell_stiffness(const std::vector<CellPoint>& points, const Stiffness& stiffness, ElementOrder order) {
  SPREKK_EXPECT(!points.empty());
  const bool is_second = order == ElementOrder::second;
  const int all = static_cast<int>(points.front().value.size()), functions = is_second ? all : all - 1;
  const int unknowns = dimension * (all - 1), columns = dimension * functions;

  // Moments of the divergence with 1, x, y, …, from which its projection follows.
  double area = 0;  // in space the volume
  Point middle = Point::Zero();
  for (const CellPoint& point : points) {
    area += point.weight;
    middle += point.weight * point.x;
  }
  middle /= area;
  const double size = dimension == 2 ? std::sqrt(area) : std::cbrt(area);
  const int terms = is_second ? 1 + dimension : 1;
  const auto basis = [&](const CellPoint& point) {
    Eigen::VectorXd value(terms);
    value[0] = 1;
    if (is_second) value.tail<dimension>() = (point.x - middle) / size;
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
    Strains projected = strain(point, functions);
    const Eigen::RowVectorXd correction =
        (basis(point).transpose() * projection - divergence(point, functions)) / dimension;
    for (int k = 0; k < dimension; ++k) projected.row(k) += correction;
    forces += point.weight * projected.transpose() * stiffness * projected;
  }
  if (!is_second) return {std::move(forces), CellPoint::Gradients::Zero(dimension, unknowns)};

  const auto interior = forces.bottomRightCorner<dimension, dimension>();
  const CellPoint::Gradients along = forces.bottomLeftCorner(dimension, unknowns);
  CellStiffness result;
  result.of_interior = -Tensor(interior).llt().solve(along);
  result.of_unknowns = forces.topLeftCorner(unknowns, unknowns) + along.transpose() * result.of_interior;
  return result;
}

}  // namespace sprekk::poromechanics
