#include "framework/discretization/principal_axes.hpp"

#include <Eigen/Eigenvalues>

namespace sprekk {

PrincipalAxes principal_axes(const Tensor& tensor) {
  const Eigen::SelfAdjointEigenSolver<Tensor> solver(tensor);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace sprekk
