#include "framework/schedule/anderson.hpp"

#include <Eigen/Dense>

#include "framework/invariants.hpp"

namespace sprekk {

Vector Anderson::next(const Vector& x, const Vector& image) {
  SPREKK_EXPECT(x.size() == image.size(), x.size(), image.size());
  SPREKK_EXPECT(is_finite(x) && is_finite(image));
  SPREKK_ASSERT(image_differences_.size() == residual_differences_.size());
  const Vector residual = image - x;
  if (last_image_.size() == image.size()) {
    image_differences_.push_back(image - last_image_);
    residual_differences_.push_back(residual - last_residual_);
    if (static_cast<int>(image_differences_.size()) > depth_) {
      image_differences_.pop_front();
      residual_differences_.pop_front();
    }
  }
  last_image_ = image;
  last_residual_ = residual;
  const int m = static_cast<int>(residual_differences_.size());
  SPREKK_ASSERT(m <= depth_, m, depth_);
  if (m == 0) return image;
  Eigen::MatrixXd differences(residual.size(), m);
  for (int j = 0; j < m; ++j) differences.col(j) = residual_differences_[j];
  const Vector weights = differences.completeOrthogonalDecomposition().solve(residual);
  Vector next = image;
  for (int j = 0; j < m; ++j) next -= weights[j] * image_differences_[j];
  return next;
}

void Anderson::forget() {
  image_differences_.clear();
  residual_differences_.clear();
  last_image_.resize(0);
}

}  // namespace sprekk
