// The least squares problem of a dense matrix of any rank.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

namespace sprekk {

/// Minimizes |A x − b|, and |x| among all that do, by a complete orthogonal decomposition of A. Copies share it.
class LeastSquares {
 public:
  LeastSquares() = default;
  /// `threshold`: pivots below this share of the largest one count as zero. Without it the bound is round-off.
  explicit LeastSquares(const Eigen::MatrixXd& matrix, const std::optional<double>& threshold = {});
  Eigen::Index rank() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  /// The minimizer for each column b of `right`.
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& right) const;
  Eigen::MatrixXd pseudo_inverse() const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

/// Minimizes |A x − b| for a matrix of full rank, by QR with column pivoting.
Eigen::VectorXd solve_by_pivoted_qr(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// The same for each column b of `right`, by QR without pivoting.
Eigen::MatrixXd solve_by_qr(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

/// A = Q R with orthonormal columns in Q: min(rows, columns) of A. R is upper triangular.
struct ThinQr {
  Eigen::MatrixXd q, r;
};
ThinQr thin_qr(const Eigen::MatrixXd& matrix);

}  // namespace sprekk
