// The Jacobian that a search for a front learns from its own moves.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace sprekk::fine_fracture {

/// The derivative of (load, direction) by (advance in increments, angle in rad), per tip, with updates of least change
/// (Broyden, Math. Comput. 19 (1965) 577). The change of an entry is measured by how uncertain the entry is: the
/// direction of a tip depends on its own segment, for example, and hardly on another one. What was learnt from other
/// moves stays. So each row is a Kalman filter (J. Basic Engng 82 (1960) 35) whose measurements are the moves. Their
/// errors are the squares of moves, which no Jacobian has.
class LearntSlopes {
 public:
  Eigen::MatrixXd jacobian;

  /// Learns from a move of the unknowns that changed the residual. Where it did so in a way that earlier moves rule
  /// out, these are forgotten.
  void update(const Eigen::VectorXd& moved, const Eigen::VectorXd& change);
  /// All entries are as uncertain again as before the first move.
  void forget_moves() { covariances_.clear(); }

 private:
  Eigen::VectorXd uncertainties(Eigen::Index row) const;

  std::vector<Eigen::MatrixXd> covariances_;  ///< of the entries of each row
};

}  // namespace sprekk::fine_fracture
