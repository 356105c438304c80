#include "framework/dense/least_squares.hpp"

#include <Eigen/QR>
#include <algorithm>

#include "framework/assert.hpp"

namespace sprekk {

struct LeastSquares::Factors : Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> {};

LeastSquares::LeastSquares(const Eigen::MatrixXd& matrix, const std::optional<double>& threshold) {
  const auto factors = std::make_shared<Factors>();
  if (threshold) factors->setThreshold(*threshold);
  factors->compute(matrix);
  factors_ = factors;
}

Eigen::Index LeastSquares::rank() const { return factors_->rank(); }

Eigen::VectorXd LeastSquares::solve(const Eigen::VectorXd& right) const {
  SPREKK_EXPECT(factors_ != nullptr && factors_->rows() == right.size(), right.size());
  return factors_->solve(right);
}

Eigen::MatrixXd LeastSquares::solve_columns(const Eigen::MatrixXd& right) const {
  SPREKK_EXPECT(factors_ != nullptr && factors_->rows() == right.rows(), right.rows());
  return factors_->solve(right);
}

Eigen::MatrixXd LeastSquares::pseudo_inverse() const { return factors_->pseudoInverse(); }

Eigen::VectorXd solve_by_pivoted_qr(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  SPREKK_EXPECT(matrix.rows() == right.size(), matrix.rows(), right.size());
  return matrix.colPivHouseholderQr().solve(right);
}

Eigen::MatrixXd solve_by_qr(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
  SPREKK_EXPECT(matrix.rows() == right.rows(), matrix.rows(), right.rows());
  return matrix.householderQr().solve(right);
}

ThinQr thin_qr(const Eigen::MatrixXd& matrix) {
  const Eigen::Index count = std::min(matrix.rows(), matrix.cols());
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(matrix);
  return {qr.householderQ() * Eigen::MatrixXd::Identity(matrix.rows(), count),
          qr.matrixQR().topRows(count).triangularView<Eigen::Upper>()};
}

}  // namespace sprekk
