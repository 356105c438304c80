// The Jacobian that a search for a front learns from its own moves.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace sprekk::fine_fracture {

/// The derivative of (load, direction) by (advance in increments, angle in rad), per tip, with updates of least change
/// (Broyden, Math. Comput. 19 (1965) 577). The change of an entry is measured by how uncertain the entry is: the
/// direction of a tip depends on its own segment, for example, and hardly on another one. Entries that a move says
/// nothing about stay as they are. So each row is a Kalman filter (J. Basic Engng 82 (1960) 35) whose measurements are
/// the moves. The error of a measurement is of the order of the square of the move, which a Jacobian neglects.
class LearntSlopes {
 public:
  Eigen::MatrixXd jacobian;

  /// Learns from a move of the unknowns that changed the residual. Where the change contradicts earlier moves, the
  /// slopes learnt from these are forgotten.
  void update(const Eigen::VectorXd& moved, const Eigen::VectorXd& change);
  /// Makes all entries as uncertain as before the first move.
  void forget_moves() { covariances_.clear(); }

 private:
  Eigen::VectorXd uncertainties(Eigen::Index row) const;

  std::vector<Eigen::MatrixXd> covariances_;  ///< covariances of the entries of each row
};

}  // namespace sprekk::fine_fracture
