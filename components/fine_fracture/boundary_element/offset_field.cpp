#include "components/fine_fracture/boundary_element/offset_field.hpp"

#include <algorithm>

#include "framework/dense/least_squares.hpp"

namespace sprekk::fine_fracture {

OffsetField::OffsetField(const std::vector<Point>& places, const Elasticity& rock)
    : places_(places), rock_(rock), along_(4 / (45 * (rock.kolosov() + 1))) {
  const auto count = static_cast<Eigen::Index>(places_.size());
  Point low = places_[0], high = places_[0];
  for (const Point& x : places_) low = low.cwiseMin(x), high = high.cwiseMax(x);
  center_ = 0.5 * (low + high);
  size_ = (high - low).maxCoeff();
  linear_.resize(count, 3);
  Eigen::MatrixXd distances(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Point x = (places_[i] - center_) / size_;
    linear_.row(i) << 1, x[0], x[1];
    for (Eigen::Index k = 0; k < count; ++k) distances(i, k) = (places_[i] - places_[k]).norm();
  }
  distances_ = DenseLu(distances);
}

OffsetField::Solution OffsetField::solution(const Eigen::Matrix3Xd& offsets,
                                            const Eigen::Matrix2Xd& body_forces) const {
  Solution solution;
  solution.field_ = this;
  if (body_forces.cols() > 0) {
    solution.mean_force_ = body_forces.col(0);
    Eigen::Matrix2Xd rest = body_forces.colwise() - solution.mean_force_;
    if (!rest.isZero(0)) {
      const Point mean = rest.rowwise().mean();
      solution.mean_force_ += mean;
      rest.colwise() -= mean;
      solution.force_weights_ = distances_.solve_columns(rest.transpose()).transpose();
    }
  }
  if (offsets.cols() == 0) {
    solution.weights_ = Vector::Zero(static_cast<Eigen::Index>(places_.size()));
    return solution;
  }
  solution.linear_ = solve_by_qr(linear_, offsets.transpose()).transpose();
  const Eigen::Matrix3Xd rest = offsets - solution.linear_ * linear_.transpose();
  const Vector isotropic = 0.5 * (rest.row(0) + rest.row(1)).transpose();
  solution.remainder_ =
      std::max((rest.row(0) - rest.row(1)).cwiseAbs().maxCoeff() / 2, rest.row(2).cwiseAbs().maxCoeff());
  solution.weights_ = distances_.solve(isotropic);
  return solution;
}

Tensor OffsetField::Solution::linear_part(const Point& x) const {
  const Point at = (x - field_->center_) / field_->size_;
  return symmetric(linear_ * Eigen::Vector3d(1, at[0], at[1]));
}

Point OffsetField::Solution::force() const {
  return field_->size_ * mean_force_ + Point(linear_(0, 1) + linear_(2, 2), linear_(2, 1) + linear_(1, 2));
}

Point OffsetField::Solution::displacement(const Point& x) const {
  const double stiffness = field_->rock_.lambda + 2 * field_->rock_.shear;
  // The squares whose stress has the divergence of the linear part.
  Point u = -(x - field_->center_).cwiseAbs2().cwiseProduct(force()) / (2 * stiffness * field_->size_);
  for (std::size_t k = 0; k < field_->places_.size(); ++k) {
    const Point way = x - field_->places_[k];
    u -= weights_[k] * way.norm() / (3 * stiffness) * way;
  }
  for (Eigen::Index k = 0; k < force_weights_.cols(); ++k) {
    const Point way = x - field_->places_[k], b = force_weights_.col(k);
    const double r = way.norm();
    u += r / (2 * field_->rock_.shear) *
         ((field_->along_ - 2.0 / 9) * r * r * b + 3 * field_->along_ * way.dot(b) * way);
  }
  return u;
}

Tensor OffsetField::Solution::stress(const Point& x) const {
  const double stiffness = field_->rock_.lambda + 2 * field_->rock_.shear;
  Tensor gradient = Tensor::Zero();
  gradient.diagonal() = -(x - field_->center_).cwiseProduct(force()) / (stiffness * field_->size_);
  double isotropic = 0;
  for (std::size_t k = 0; k < field_->places_.size(); ++k) {
    const Point way = x - field_->places_[k];
    const double r = way.norm();
    isotropic += weights_[k] * r;
    if (r == 0) continue;
    gradient -= weights_[k] / (3 * stiffness) * (r * Tensor::Identity() + way * way.transpose() / r);
  }
  for (Eigen::Index k = 0; k < force_weights_.cols(); ++k) {
    const Point way = x - field_->places_[k], b = force_weights_.col(k);
    const double r = way.norm(), along = field_->along_;
    if (r == 0) continue;
    gradient += 3 / (2 * field_->rock_.shear) *
                ((along - 2.0 / 9) * r * b * way.transpose() +
                 along * (way.dot(b) * (way * way.transpose() / r + r * Tensor::Identity()) + r * way * b.transpose()));
  }
  return field_->rock_.stress(gradient) + linear_part(x) + isotropic * Tensor::Identity();
}

}  // namespace sprekk::fine_fracture
