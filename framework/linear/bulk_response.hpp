// What the bulk answers to the unknowns on fractures, as their equations feel it.
#pragma once

#include <vector>

#include "framework/linear/bulk_splitting.hpp"

namespace sprekk {

/// X = A_BB^-1 A_BF, one column for each of BulkSplitting::felt. The equations of F read few of its rows, those of
/// A_FB; they are always kept. The rest of X only spares a back-solve for x_B, and is kept where it is not too large.
class BulkResponse {
 public:
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// `largest`: entries of X up to which it is kept, 1.2 GB. Else it is computed by so many columns at a time, a
  /// multiple of what solvers take together, since others would be rounded differently.
  explicit BulkResponse(double largest = 1.5e8, int columns = 256) : largest_(largest), piece_(columns) {}

  /// Solves for the columns of X with the solver that has factorized A_BB. False if it cannot.
  bool compute(const BulkSplitting& split, LinearSolver& solver);
  bool is_whole() const { return is_whole_; }

  /// A_FB X, a row for each of BulkSplitting::feeling. Rows of A_FB whose bits are those of the last call are not
  /// multiplied again.
  const RowMatrix& felt_rows(const BulkSplitting& split);

  /// x_B − X x_F. `solver` as for `compute`; it is used where X is not whole.
  void subtract(const BulkSplitting& split, LinearSolver& solver, const Vector& local, Vector& bulk) const;

 private:
  double largest_;
  int piece_;
  bool is_whole_ = false;
  Eigen::MatrixXd columns_;           ///< X, if it is whole
  RowMatrix near_;                    ///< the rows of X that A_FB has columns for: BulkSplitting::near
  RowMatrix felt_rows_;               ///< A_FB X
  std::vector<double> of_felt_rows_;  ///< the values of A_FB that it was made with; empty for none
};

}  // namespace sprekk
