#include "framework/dense/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

#include "framework/assert.hpp"

namespace sprekk {

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix) {
  SPREKK_EXPECT(matrix.rows() == matrix.cols(), matrix.rows(), matrix.cols());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix) {
  SPREKK_EXPECT(matrix.rows() == matrix.cols(), matrix.rows(), matrix.cols());
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  SPREKK_EXPECT(a.rows() == a.cols() && a.rows() == b.rows() && a.cols() == b.cols(), a.rows(), b.rows());
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(a, b, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace sprekk
