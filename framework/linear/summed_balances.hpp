// Solves with the sum of balances in place of one of them, where what is exchanged hides what is stored.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Rows of one block of local unknowns that exchange something among themselves, [[S, D], [-D^T, 1/C]] for contents and
/// exchanges: a column of D has two entries that cancel to the bit, what leaves one row enters the other. Where C is
/// above S/eps, the level of the contents is well determined, by the sum of the rows, but elimination adds S to C and
/// loses it. Here the sum of such rows, in which D is absent, takes the place of the first of them: the same equations,
/// and S keeps its digits. Rows are summed where S is below 1e-6 of C, and what leads out of them below 1e-3. A sum
/// that is zero is a level that nothing holds.
class SummedBalances final : public LinearSolver {
 public:
  explicit SummedBalances(std::unique_ptr<LinearSolver> solver);

  LinearReport factor(const LinearSystem& system) override;
  LinearReport solve(const Vector& b_rows, Vector& x) override;
  bool solve_columns(Eigen::Ref<Eigen::MatrixXd> columns) override;
  /// Only where there is nothing to sum.
  std::optional<LinearReport> factor_bordered(const LinearSystem& system, const SparseMatrix& columns,
                                              const SparseMatrix& rows, Eigen::MatrixXd& response) override;
  std::string name() const override { return solver_->name(); }
  const LinearCounts& counts() const override { return solver_->counts(); }

 private:
  /// Rows of the whole system whose sum replaces the first of them. `owned` are those of this process, as places in
  /// its right-hand side.
  struct Sum {
    std::vector<int> rows, owned;
    int replaced = -1;  ///< place of the first row in the right-hand side, if it is this process's
  };
  std::unique_ptr<LinearSolver> solver_;
  std::vector<Sum> sums_;
};

/// The groups of rows that SummedBalances sums, each in ascending order. `rows` has at least all rows of the local
/// blocks.
std::vector<std::vector<int>> exchanging_rows(const SparseMatrix& rows, const std::vector<UnknownBlock>& blocks);

}  // namespace sprekk
