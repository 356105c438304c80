// The stiffness of the fine level's unknowns, factorized.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "components/fine_fracture/quarter_point/elasticity/block_cholesky.hpp"
#include "components/fine_fracture/quarter_point/elasticity/unknowns.hpp"
#include "framework/output/profile.hpp"

namespace sprekk::fine_fracture {

/// The stiffness of an element: six nodes with two components each.
using ElementMatrix = Eigen::Matrix<double, 12, 12>;

/// The factorized stiffness matrix, with a block for the two unknowns of each node, in an order of minimum degree of
/// the corners of elements. A node with one unknown gets a second one that is not coupled to others.
class StiffnessFactors {
 public:
  /// `stiffness`: by element. Times ordering, assembly and factorization in `profile`. Throws std::runtime_error when
  /// the matrix is singular.
  StiffnessFactors(const FineMesh& mesh, const Unknowns& unknowns, const std::vector<ElementMatrix>& stiffness,
                   Profile& profile);
  Vector solve(const Vector& b) const;
  /// The solutions in some unknowns, for right-hand sides that are zero in all others: a row for each of `unknowns`.
  /// Rows of b for the same unknown add up.
  Eigen::MatrixXd solve_within(const std::vector<int>& unknowns, const Eigen::MatrixXd& b) const;

 private:
  int block_count_ = 0;
  std::vector<int> place_;  ///< by unknown: its place in the vector of blocks
  std::optional<BlockCholesky> factors_;
};

}  // namespace sprekk::fine_fracture
