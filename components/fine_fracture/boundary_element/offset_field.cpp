#include "components/fine_fracture/boundary_element/offset_field.hpp"

#include <Eigen/QR>
#include <algorithm>

namespace sprekk::fine_fracture {

OffsetField::OffsetField(const std::vector<Point>& places, const Elasticity& rock) : places_(places), rock_(rock) {
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
  distances_.compute(distances);
}

OffsetField::Solution OffsetField::solution(const Eigen::Matrix3Xd& offsets) const {
  Solution solution;
  solution.field_ = this;
  solution.linear_ = linear_.householderQr().solve(offsets.transpose()).transpose();
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

Point OffsetField::Solution::displacement(const Point& x) const {
  const double stiffness = field_->rock_.lambda + 2 * field_->rock_.shear;
  // The squares whose stress has the divergence of the linear part.
  const Point force(linear_(0, 1) + linear_(2, 2), linear_(2, 1) + linear_(1, 2));  // Pa, times the size
  Point u = -(x - field_->center_).cwiseAbs2().cwiseProduct(force) / (2 * stiffness * field_->size_);
  for (std::size_t k = 0; k < field_->places_.size(); ++k) {
    const Point way = x - field_->places_[k];
    u -= weights_[k] * way.norm() / (3 * stiffness) * way;
  }
  return u;
}

Tensor OffsetField::Solution::stress(const Point& x) const {
  const double stiffness = field_->rock_.lambda + 2 * field_->rock_.shear;
  const Point force(linear_(0, 1) + linear_(2, 2), linear_(2, 1) + linear_(1, 2));
  Tensor gradient = Tensor::Zero();
  gradient.diagonal() = -(x - field_->center_).cwiseProduct(force) / (stiffness * field_->size_);
  double isotropic = 0;
  for (std::size_t k = 0; k < field_->places_.size(); ++k) {
    const Point way = x - field_->places_[k];
    const double r = way.norm();
    isotropic += weights_[k] * r;
    if (r == 0) continue;
    gradient -= weights_[k] / (3 * stiffness) * (r * Tensor::Identity() + way * way.transpose() / r);
  }
  return field_->rock_.stress(gradient) + linear_part(x) + isotropic * Tensor::Identity();
}

}  // namespace sprekk::fine_fracture
