// The LU decompositions of square dense matrices.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace sprekk {

/// P A = L U with partial pivoting, for a matrix that is known to be regular. Copies share the factors.
class DenseLu {
 public:
  DenseLu() = default;
  explicit DenseLu(const Eigen::MatrixXd& matrix);
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  /// For each column of `right`.
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& right) const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

/// P A Q = L U with full pivoting, which tells whether the matrix is regular. Copies share the factors.
class FullPivotingLu {
 public:
  explicit FullPivotingLu(const Eigen::MatrixXd& matrix);
  bool is_invertible() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  /// For each column of `right`.
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& right) const;
  Eigen::MatrixXd inverse() const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

}  // namespace sprekk
