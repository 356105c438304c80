// The Schur complement of the bulk: what its elimination adds to the equations of the interface unknowns.
#pragma once

#include <optional>
#include <vector>

#include "framework/linear/reduction/bulk_splitting.hpp"

namespace sprekk {

/// X = A_BB^-1 A_BF, one column for each of BulkSplitting::interface_columns, as far as it is needed. The equations of
/// F read A_FB X, which a solver may give while it factorizes (LinearSolver::factor_bordered), for less than the
/// columns of X cost. X itself spares a back-solve for each x_B, so that it pays after some hundred of them. Of its
/// rows those are kept that A_FB reads, and the rest where it is not too large.
class BulkSchurComplement {
 public:
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// `largest`: entries of X up to which it is kept, 1.2 GB. Else it is computed by so many columns at a time, a
  /// multiple of what solvers take together, since others would be rounded differently.
  explicit BulkSchurComplement(double largest = 1.5e8, int columns = 256) : largest_(largest), piece_(columns) {}

  /// Factorizes A_BB and finds the Schur complement. `is_short_lived`: it serves a few systems only, for which X is not
  /// worth its price where the solver can do without.
  LinearReport compute(const BulkSplitting& split, LinearSolver& solver, bool is_short_lived);
  /// Whether X is kept, all of it.
  bool is_whole() const { return is_whole_; }

  /// A_FB X, a row for each of BulkSplitting::interface_rows. Rows of A_FB whose bits are those of the last call are
  /// not multiplied again, and those that only a power of two has scaled since `compute` are scaled; for others the
  /// factorization is made again. So the bits depend on the matrices, and not on those that were seen before. `solver`:
  /// the one that `compute` was given. Null when that factorization fails.
  const RowMatrix* schur_rows(const BulkSplitting& split, LinearSolver& solver);

  /// x_B − X x_F. `solver` as for `schur_rows`; it is used where X is not whole.
  void subtract(const BulkSplitting& split, LinearSolver& solver, const Vector& local, Vector& bulk) const;

 private:
  std::optional<LinearReport> compute_bordered(const BulkSplitting& split, LinearSolver& solver);
  bool are_multiples_of_bordered(const BulkSplitting& split) const;
  bool solve_columns(const BulkSplitting& split, LinearSolver& solver);
  void multiply(const BulkSplitting& split, std::size_t k);

  double largest_;
  int piece_;
  bool is_whole_ = false;
  Eigen::MatrixXd columns_;                   ///< X, if it is whole
  RowMatrix near_;                            ///< the rows of X that A_FB has columns for: BulkSplitting::near
  RowMatrix bordered_;                        ///< A_FB X as the factorization gave it,
  std::vector<double> of_bordered_;           ///< and the values of A_FB that it had
  RowMatrix schur_rows_;                      ///< A_FB X
  std::vector<double> schur_rows_made_with_;  ///< the values of A_FB that it was made with; empty for none
};

}  // namespace sprekk
