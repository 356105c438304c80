#include "framework/dense/cholesky.hpp"

#include <Eigen/Cholesky>

#include "framework/assert.hpp"

namespace sprekk {

struct DenseCholesky::Factors : Eigen::LLT<Eigen::MatrixXd> {
  using LLT::LLT;
};

DenseCholesky::DenseCholesky(const Eigen::MatrixXd& matrix) : factors_(std::make_shared<const Factors>(matrix)) {}

bool DenseCholesky::is_positive_definite() const { return factors_->info() == Eigen::Success; }

Eigen::MatrixXd DenseCholesky::solve_columns(const Eigen::MatrixXd& right) const {
  SPREKK_EXPECT(factors_->rows() == right.rows(), right.rows());
  return factors_->solve(right);
}

}  // namespace sprekk
