// Pinned points of a rock whose unknowns are displacements of cells.
#pragma once

#include <vector>

#include "components/poromechanics/options.hpp"
#include "framework/assembly/step_time.hpp"

namespace sprekk::poromechanics {

/// A displacement that is given at a node, along an axis, is the equation
///   sum of w_c u_c = value  over cells c near the node,
/// exact for linear displacements, with the least weights (of w_c |x_c − x|). It replaces the balance of the nearest
/// cell along this axis: that cell bears what loads leave. Which is nothing where they are in balance.
class PinnedCells {
 public:
  /// Throws InputError where cells near a point do not determine a linear displacement.
  PinnedCells(const Options& options, const Mesh& mesh);

  bool is_empty() const { return equations_.empty(); }
  /// The balances of cells as they depend on the displacement, with the equations of the points in owned rows, times
  /// the diagonal of the balance that each one replaces.
  SparseMatrix hold(const SparseMatrix& balances);
  /// The balances as they depend on something else: without the replaced ones.
  SparseMatrix clear(const SparseMatrix& balances) const;
  /// Puts given displacements (m, one an equation) into the constants of balances. After `hold`.
  void give(const Vector& displacements, Vector& constants) const;
  /// The given displacements of a step, m. Throws DataError.
  Vector displacements(const StepTime& step) const;

 private:
  struct Equation {
    const Data* given;  ///< m
    Place place;
    int row;                                      ///< of a balance
    std::vector<std::pair<int, double>> weights;  ///< by value of the displacement field
    double scale = 0;
  };
  const Mesh& mesh_;
  std::vector<Equation> equations_;
};

}  // namespace sprekk::poromechanics
