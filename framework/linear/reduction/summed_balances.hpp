// Solves with the sum of balances in place of one of them if large exchanges between rows hide their storage.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Replaces one row of near-singular balances by their sum. Rows of one block of local unknowns may exchange amounts
/// among themselves, [[S, D], [-D^T, 1/C]] for contents (potentials) and exchanges (fluxes): a column of D has two
/// entries that cancel to the bit, as what leaves one row enters the other. Where C is above S/eps, the sum of the rows
/// determines the constant mode of the potentials well, but elimination adds S to C and loses S. Here the sum of such
/// rows, in which D is absent, takes the place of the first of them: the equations are equivalent, and S keeps its
/// digits. Rows are summed where S is below 1e-6 of C, and entries that lead out of the rows below 1e-3. A flux that
/// another row prescribes, such as the rate of a well, does not count as leading out: a multiple of that row takes it
/// out of the sum. A zero sum means a singular matrix, whose constant mode nothing determines. In systems with a sum,
/// the first row of every group that may be summed gets all columns of such a sum, as zeros where it has no entry. So
/// the pattern does not depend on which groups are summed, and one ordering serves all systems. It does not depend on
/// earlier systems either, so a restarted run has the bits of one that was not interrupted.
class SummedBalances final : public LinearSolver {
 public:
  explicit SummedBalances(std::unique_ptr<LinearSolver> solver);

  LinearReport factor(const LinearSystem& system) override;
  LinearReport solve(const Vector& b_rows, Vector& x) override;
  bool solve_columns(Eigen::Ref<Eigen::MatrixXd> columns) override;
  /// std::nullopt where there are rows to sum: then a border is not supported.
  std::optional<LinearReport> factor_bordered(const LinearSystem& system, const SparseMatrix& columns,
                                              const SparseMatrix& rows, Eigen::MatrixXd& schur) override;
  std::string name() const override { return solver_->name(); }
  const LinearCounts& counts() const override { return solver_->counts(); }

 private:
  /// Rows of the whole system whose sum replaces the first of them. `owned` are those of this process, as places in
  /// its right-hand side.
  struct Sum {
    std::vector<int> rows, owned;
    int replaced = -1;  ///< place of the first row in the right-hand side, if it is this process's
    std::vector<std::pair<int, double>> given, owned_given;  ///< rows that give fluxes out of these, and their factors
  };
  std::unique_ptr<LinearSolver> solver_;
  std::vector<Sum> sums_;
};

/// A group of rows that exchanges may join, ascending, and the columns that their sum may have.
struct PossibleSum {
  std::vector<int> rows, columns;
};

/// All groups of rows that SummedBalances may sum, by the pattern and the blocks alone: those joined by columns with
/// two entries, which are no columns of the sum. `rows` as below.
std::vector<PossibleSum> possible_sums(const SparseMatrix& rows, const std::vector<UnknownBlock>& blocks);

/// The groups of rows that SummedBalances sums, each in ascending order. `rows` has at least all rows of the local
/// blocks.
std::vector<std::vector<int>> exchanging_rows(const SparseMatrix& rows, const std::vector<UnknownBlock>& blocks);

}  // namespace sprekk
