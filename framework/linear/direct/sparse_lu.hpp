// The LU decomposition of a small sparse matrix outside of the equations of a scene; its code takes six seconds to
// compile.
#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace sprekk {

/// Factors of a square sparse matrix (Eigen::SparseLU). The ordering is that of the first matrix, which later ones
/// share their pattern with. Copies share it.
class SparseLu {
 public:
  SparseLu();
  /// False: the matrix is singular.
  bool factorize(const Eigen::SparseMatrix<double>& matrix);
  /// x with A x = `right`; asks for a successful factorize().
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  struct Factors;
  std::shared_ptr<Factors> factors_;
};

}  // namespace sprekk
