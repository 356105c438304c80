// The stiffness of the fine level's unknowns, factorized.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "components/fine_fracture/quarter_point/elasticity/block_cholesky.hpp"
#include "components/fine_fracture/quarter_point/elasticity/unknowns.hpp"
#include "framework/output/profile.hpp"

namespace sprekk::fine_fracture {

/// The stiffness of an element: six nodes with two components each.
using ElementMatrix = Eigen::Matrix<double, 12, 12>;

/// In which order the blocks of unknowns are eliminated, and where their matrix has entries: the same for all meshes of
/// one topology. Blocks are numbered as their nodes come.
struct EliminationOrder {
  std::vector<int> first_unknown;              ///< by block
  std::vector<std::array<int, 6>> of_element;  ///< the blocks of its nodes, or none
  std::vector<int> place;                      ///< by block: its place in the order
  BlockMatrix pattern;                         ///< in that order, without values
  /// By element: the block of the matrix for each pair of its nodes, or none below the diagonal.
  std::vector<std::array<int, 36>> targets;
};

/// The factorized stiffness matrix, with a block for the two unknowns of each node, in an order of minimum degree of
/// the corners of elements. A node with one unknown gets a second one that is not coupled to others.
class StiffnessFactors {
 public:
  /// `stiffness`: by element. Times ordering, assembly and factorization in `profile`. `known`: an order that is taken
  /// where the mesh has its topology, or null. Throws std::runtime_error when the matrix is singular.
  StiffnessFactors(const FineMesh& mesh, const Unknowns& unknowns, const std::vector<ElementMatrix>& stiffness,
                   Profile& profile, std::shared_ptr<const EliminationOrder> known);
  const std::shared_ptr<const EliminationOrder>& order() const { return order_; }
  Vector solve(const Vector& b) const;
  /// The solutions in some unknowns, for right-hand sides that are zero in all others: a row for each of `unknowns`.
  /// Rows of b for the same unknown add up.
  Eigen::MatrixXd solve_within(const std::vector<int>& unknowns, const Eigen::MatrixXd& b) const;

 private:
  int block_count() const { return static_cast<int>(order_->place.size()); }

  std::shared_ptr<const EliminationOrder> order_;
  std::vector<int> place_;  ///< by unknown: its place in the vector of blocks
  std::optional<BlockCholesky> factors_;
};

}  // namespace sprekk::fine_fracture
