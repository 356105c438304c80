// The front for loads that are linear in the advances.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace sprekk::fine_fracture {

/// Loads r = loads + slopes (a - at) of n tips with the advances a >= 0 (increments).
struct LinearLoads {
  Eigen::VectorXd loads;   ///< n
  Eigen::MatrixXd slopes;  ///< n x n, 1/increment
  Eigen::VectorXd at;      ///< n, increments
};

/// The advances a >= 0 with F_i = 0, or a_i = 0 and F_i <= 0, where F is the residual of most_equal_front(). It is
/// found by Newton's method with steps that make F smaller, and else by following da/dt = F to its rest and Newton's
/// method from there. Nothing where neither finds it, for example where loads rise with lengths.
std::optional<Eigen::VectorXd> linear_front(const LinearLoads& model, double mesh_error);

}  // namespace sprekk::fine_fracture
