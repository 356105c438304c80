// Eigenvalues and eigenvectors of symmetric matrices.
#pragma once

#include "framework/types.hpp"

namespace sprekk {

/// Eigenvalues and eigenvectors of a symmetric matrix of any size, of which only the lower triangle is read.
struct SymmetricEigen {
  Eigen::VectorXd values;   ///< in ascending order
  Eigen::MatrixXd vectors;  ///< a column each, of length 1
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

/// The eigenvalues of a symmetric matrix, in ascending order.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

/// The numbers λ with A x = λ B x, in ascending order, for a symmetric A and a symmetric positive definite B of its
/// size.
Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace sprekk
