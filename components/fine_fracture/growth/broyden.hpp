// The Jacobian that a search learns from its own moves.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace sprekk::fine_fracture {

/// Broyden's matrix (Math. Comput. 19 (1965) 577), with projected updates (Gay and Schnabel, Nonlin. Progr. 3 (1978)
/// 245): what was learnt from other moves stays. What a move has missed is shared by the unknowns in proportion to the
/// squares of their expected effects, moves times the norms of their columns: lengths and angles have no common unit.
class Broyden {
 public:
  Eigen::MatrixXd jacobian;

  /// Learns from a move of the unknowns that changed the residual.
  void update(const Eigen::VectorXd& moved, const Eigen::VectorXd& change);
  /// The next updates may change the Jacobian in all directions.
  void forget_moves() { learnt_.clear(); }

 private:
  Eigen::VectorXd effects() const;

  std::vector<Eigen::VectorXd> learnt_;  ///< orthonormal: the scaled directions in which the Jacobian is that of moves
  Eigen::VectorXd scale_;                ///< effects of the unknowns when the first of them was learnt
};

}  // namespace sprekk::fine_fracture
