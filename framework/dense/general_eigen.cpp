#include "framework/dense/general_eigen.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "framework/assert.hpp"

namespace sprekk {

std::vector<RealEigenpair> real_eigenpairs(const Eigen::MatrixXd& matrix) {
  SPREKK_EXPECT(matrix.rows() == matrix.cols(), matrix.rows(), matrix.cols());
  constexpr double round_off = 1e-10;  // of the eigenvalue: round-off of the decomposition
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
  std::vector<RealEigenpair> pairs;
  for (Eigen::Index k = 0; k < matrix.rows(); ++k) {
    const std::complex<double> value = solver.eigenvalues()[k];
    if (std::abs(value.imag()) > round_off * std::abs(value.real())) continue;
    pairs.push_back({value.real(), solver.eigenvectors().col(k).real().normalized()});
  }
  return pairs;
}

}  // namespace sprekk
