#include "framework/linear/direct/sparse_lu.hpp"

#include <Eigen/SparseLU>

#include "framework/assert.hpp"

namespace sprekk {

struct SparseLu::Factors : Eigen::SparseLU<Eigen::SparseMatrix<double>> {
  bool has_ordering = false;
};

SparseLu::SparseLu() : factors_(std::make_shared<Factors>()) {}

bool SparseLu::factorize(const Eigen::SparseMatrix<double>& matrix) {
  SPREKK_EXPECT(matrix.rows() == matrix.cols(), matrix.rows(), matrix.cols());
  if (!factors_->has_ordering) factors_->analyzePattern(matrix);
  factors_->has_ordering = true;
  factors_->factorize(matrix);
  return factors_->info() == Eigen::Success;
}

Eigen::VectorXd SparseLu::solve(const Eigen::VectorXd& right) const {
  SPREKK_EXPECT(factors_->rows() == right.size() && factors_->info() == Eigen::Success, right.size());
  return factors_->solve(right);
}

}  // namespace sprekk
