// The Cholesky decomposition of dense symmetric matrices.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace sprekk {

/// A = L Lᵀ, of which only the lower triangle is read. Copies share the factors.
class DenseCholesky {
 public:
  explicit DenseCholesky(const Eigen::MatrixXd& matrix);
  bool is_positive_definite() const;
  /// Solves A x = b for each column b of `right`.
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& right) const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

}  // namespace sprekk
