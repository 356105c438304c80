#include "framework/dense/lu.hpp"

#include <Eigen/LU>

#include "framework/assert.hpp"

namespace sprekk {

struct DenseLu::Factors : Eigen::PartialPivLU<Eigen::MatrixXd> {
  using PartialPivLU::PartialPivLU;
};

DenseLu::DenseLu(const Eigen::MatrixXd& matrix) : factors_(std::make_shared<const Factors>(matrix)) {}

Eigen::VectorXd DenseLu::solve(const Eigen::VectorXd& right) const {
  SPREKK_EXPECT(factors_ != nullptr && factors_->rows() == right.size(), right.size());
  return factors_->solve(right);
}

Eigen::MatrixXd DenseLu::solve_columns(const Eigen::MatrixXd& right) const {
  SPREKK_EXPECT(factors_ != nullptr && factors_->rows() == right.rows(), right.rows());
  return factors_->solve(right);
}

struct FullPivotingLu::Factors : Eigen::FullPivLU<Eigen::MatrixXd> {
  using FullPivLU::FullPivLU;
};

FullPivotingLu::FullPivotingLu(const Eigen::MatrixXd& matrix) : factors_(std::make_shared<const Factors>(matrix)) {}

bool FullPivotingLu::is_invertible() const { return factors_->isInvertible(); }

Eigen::VectorXd FullPivotingLu::solve(const Eigen::VectorXd& right) const {
  SPREKK_EXPECT(factors_->rows() == right.size(), right.size());
  return factors_->solve(right);
}

Eigen::MatrixXd FullPivotingLu::solve_columns(const Eigen::MatrixXd& right) const {
  SPREKK_EXPECT(factors_->rows() == right.rows(), right.rows());
  return factors_->solve(right);
}

Eigen::MatrixXd FullPivotingLu::inverse() const { return factors_->inverse(); }

}  // namespace sprekk
