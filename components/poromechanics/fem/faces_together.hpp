// What displaces the functions of faces at first order, where they are no unknowns.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "components/poromechanics/fem/held_directions.hpp"
#include "components/poromechanics/fem/raw_displacement.hpp"
#include "framework/types.hpp"

namespace sprekk::poromechanics {

/// The stiffness against which forces displace the functions of faces: each function as if it stood alone, those of a
/// group (groups_at_tips) together. In each cell it is at least that of all its functions of faces together, so that
/// what is left for the nodes is positive definite; where all faces of a cell are of one group, it is equal to that.
class FacesTogether {
 public:
  FacesTogether(const RawDisplacement& raw, std::vector<int> groups);

  /// Adds the stiffness of a cell (CellStiffness::of_unknowns).
  void add(int cell, const Eigen::MatrixXd& of_unknowns);
  /// Adds the stiffness of springs on outer faces of a cell, as it is: it couples no two faces.
  void add_springs(int cell, const Eigen::MatrixXd& of_unknowns);

  /// All coefficients (RawDisplacement), of which those of nodes are 0, as functions of
  struct Displaced {
    SparseMatrix of_force;  ///< forces on the functions of faces, N/m (N in space): a compliance, 0 along held axes
    SparseMatrix of_given;  ///< displacements that are prescribed along held axes, m
  };
  Displaced displaced(const Held& held) const;

 private:
  std::vector<std::vector<int>> of_each_group() const;

  RawDisplacement raw_;
  std::vector<int> groups_;
  std::vector<Tensor> alone_;       ///< the stiffness of each face that is in no group
  std::vector<Triplet> of_groups_;  ///< that of all faces in groups
};

}  // namespace sprekk::poromechanics
