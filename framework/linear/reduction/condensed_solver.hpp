// Condenses the bulk out of a system: one factorization of the bulk serves all systems that differ on fractures only.
#pragma once

#include <list>
#include <memory>

#include "framework/linear/direct/umfpack_solver.hpp"
#include "framework/linear/linear_solver.hpp"
#include "framework/linear/reduction/summed_balances.hpp"

namespace sprekk {

class BulkSplitting;

/// With B the unknowns of the bulk and F those on interfaces (BlockKind):
///
///   [A_BB A_BF] [x_B]   [b_B]      X = A_BB^-1 A_BF,  S = A_FF − A_FB X
///   [A_FB A_FF] [x_F] = [b_F]      S x_F = b_F − A_FB A_BB^-1 b_B,  x_B = A_BB^-1 b_B − X x_F
///
/// S is the Schur complement of the bulk. The equations of the bulk are linear, so A_BB and A_BF stay as long as the
/// mesh and the time step do. A new system then costs the factorization of S. A right-hand side costs one back-solve
/// with A_BB, or none where b_B = 0, and one more where X is too large to be kept (BulkSchurComplement). X has a column
/// for each unknown of F that has entries in A_BF. The factorizations of the last two bulks are kept, for two time
/// steps.
///
/// The whole system is solved instead where there is nothing to condense, where S costs more than the whole, as long as
/// X would cost more than it could have saved so far, and where the first solution with a bulk turns out to be
/// inaccurate. On several processes each has its rows of B and of X; S is small, and every process has all of it. Where
/// only fractures hold a block of rock, a cell or two of the block join F, so that A_BB is not
/// singular (unknowns_held_by_fractures).
class CondensedSolver final : public LinearSolver {
 public:
  explicit CondensedSolver(const LinearOptions& options);
  ~CondensedSolver() override;

  LinearReport factor(const LinearSystem& system) override;
  LinearReport solve(const Vector& b_rows, Vector& x) override;
  std::string name() const override;
  const LinearCounts& counts() const override;

 private:
  struct Bulk;  ///< a factorization of A_BB, with X
  LinearReport condense(const LinearSystem& system);
  void split_anew(const LinearSystem& system, std::vector<char> held);
  void remember_bulk();
  void choose_bulk();
  LinearReport solve_condensed(const Vector& b_bulk, const Vector& b_local, Vector& bulk, Vector& local);
  LinearReport solve_reduced(const Vector& b, Vector& x);
  bool verifies(const Vector& b_bulk, const Vector& b_local, const Vector& bulk, const Vector& local);
  LinearReport factor_whole(const LinearSystem& system);

  LinearOptions options_;
  std::unique_ptr<BulkSplitting> splitting_;
  /// Numbers of the last system that was split, and of the last one that was reduced (LinearSystem::number).
  std::uint64_t pattern_number_ = 0, number_ = 0, reduced_number_ = 0;
  LinearReport reduced_report_;
  std::list<Bulk> bulks_;  ///< the one in use first
  SparseMatrix reduced_pattern_;
  SummedBalances reduced_{std::make_unique<UmfpackSolver>()};
  std::unique_ptr<LinearSolver> whole_;
  bool is_condensed_ = false;
  LinearCounts retired_;
  mutable LinearCounts total_;
};

}  // namespace sprekk
