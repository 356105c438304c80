// Real eigenvalues and eigenvectors of matrices that need not be symmetric.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// An eigenvalue that is real, and its eigenvector, of length 1.
struct RealEigenpair {
  double value;
  Eigen::VectorXd vector;
};
/// All that are real except for round-off, in no order.
std::vector<RealEigenpair> real_eigenpairs(const Eigen::MatrixXd& matrix);

}  // namespace sprekk
