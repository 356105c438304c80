// The Schur complement of the bulk: what elimination of the bulk adds to the equations on fractures.
#pragma once

#include <optional>
#include <vector>

#include "framework/linear/reduction/bulk_splitting.hpp"

namespace sprekk {

/// Computes A_FB X for the Schur complement A_FF − A_FB X, where X = A_BB^-1 A_BF has a column for each of
/// BulkSplitting::interface_columns. A solver may give A_FB X while it factorizes (LinearSolver::factor_bordered), for
/// less than the columns of X cost. X itself spares a back-solve for each x_B, which pays after some hundred solves.
/// The rows of X that A_FB reads are kept; all of X is kept where it is not too large.
class BulkSchurComplement {
 public:
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// `largest`: the number of entries of X up to which all of X is kept (1.2 GB). A larger X is computed by `columns`
  /// columns at a time, a multiple of the number that solvers take together: any other number would change rounding.
  explicit BulkSchurComplement(double largest = 1.5e8, int columns = 256) : largest_(largest), piece_(columns) {}

  /// Factorizes A_BB and computes A_FB X. `is_short_lived`: the bulk serves a few systems only, for which X does not
  /// pay where the solver can do without.
  LinearReport compute(const BulkSplitting& split, LinearSolver& solver, bool is_short_lived);
  /// Whether X is kept, all of it.
  bool is_whole() const { return is_whole_; }

  /// A_FB X, a row for each of BulkSplitting::interface_rows. Products of rows of A_FB that have not changed since the
  /// last call are kept, and products of rows that have only been scaled by a power of two since `compute` are scaled;
  /// for other rows the factorization is made again. So the bits depend on the matrices alone, and not on earlier
  /// matrices. `solver`: the solver that `compute` was given. Null when that factorization fails.
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
  RowMatrix bordered_;                        ///< A_FB X as the last bordered factorization gave it
  std::vector<double> of_bordered_;           ///< the values of A_FB in that factorization
  RowMatrix schur_rows_;                      ///< A_FB X
  std::vector<double> schur_rows_made_with_;  ///< the values of A_FB that they were made with; empty for none
};

}  // namespace sprekk
