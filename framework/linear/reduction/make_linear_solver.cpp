#include <stdexcept>

#include "framework/invariants.hpp"
#include "framework/linear/direct/mumps_solver.hpp"
#include "framework/linear/direct/umfpack_solver.hpp"
#include "framework/linear/iterative/belos_solver.hpp"
#include "framework/linear/linear_solver.hpp"
#include "framework/linear/reduction/condensed_solver.hpp"
#include "framework/linear/reduction/separated_solver.hpp"
#include "framework/linear/reduction/summed_balances.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

/// Chooses a solver for the first system, and again when the number of unknowns crosses a limit. A direct solver is
/// accurate to rounding error, and in two dimensions faster up to some hundred thousand unknowns; above, its memory is
/// the limit.
class AutomaticSolver final : public LinearSolver {
 public:
  explicit AutomaticSolver(const LinearOptions& options) : options_(options) {}

  LinearReport factor(const LinearSystem& system) override { return chosen_for(system).factor(system); }
  std::optional<LinearReport> factor_bordered(const LinearSystem& system, const SparseMatrix& columns,
                                              const SparseMatrix& rows, Eigen::MatrixXd& schur) override {
    return chosen_for(system).factor_bordered(system, columns, rows, schur);
  }
  LinearReport solve(const Vector& b_rows, Vector& x) override {
    if (!chosen_) return LinearReport::failure("solve was called before factor");
    return chosen_->solve(b_rows, x);
  }
  bool solve_columns(Eigen::Ref<Eigen::MatrixXd> columns) override {
    return chosen_ && chosen_->solve_columns(columns);
  }
  std::string name() const override { return chosen_ ? chosen_->name() : "auto"; }
  const LinearCounts& counts() const override { return chosen_ ? chosen_->counts() : counts_; }

 private:
  LinearSolver& chosen_for(const LinearSystem& system) {
    // MUMPS factorizes 1.4 to 2.8 times faster than UMFPACK, but it starts MPI, and a back-solve of few unknowns takes
    // it twice as long.
    constexpr int smallest_for_mumps = 10'000;
    const auto unknowns = system.local.cols();
    const bool is_for_mumps = parallel::size() > 1 || options_.bulk_changes_often || unknowns >= smallest_for_mumps;
    const char* const type = unknowns > options_.largest_for_direct ? "belos" : is_for_mumps ? "mumps" : "umfpack";
    if (!chosen_ || chosen_->name() != type) {
      options_.type = type;
      chosen_ = make_linear_solver(options_);
    }
    return *chosen_;
  }

  LinearOptions options_;
  std::unique_ptr<LinearSolver> chosen_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_linear_solver(const LinearOptions& options) {
  if (options.type == "auto") return std::make_unique<AutomaticSolver>(options);
  if (options.type == "mumps") return std::make_unique<SummedBalances>(std::make_unique<MumpsSolver>());
  if (options.type == "belos") return std::make_unique<BelosSolver>(options.tolerance, options.max_iterations);
  if (options.type == "umfpack") {
    SPREKK_EXPECT(parallel::size() == 1, "'umfpack' knows one process only; solver_spec refuses it on several");
    return std::make_unique<SummedBalances>(std::make_unique<UmfpackSolver>());
  }
  throw std::invalid_argument("unknown linear solver '" + options.type + "' (there are: auto, umfpack, mumps, belos)");
}

bool is_direct(const LinearOptions& options, int unknowns) {
  return options.type == "auto" ? unknowns <= options.largest_for_direct : options.type != "belos";
}

std::unique_ptr<LinearSolver> make_condensing_solver(const LinearOptions& options) {
  if (options.type == "belos") return make_linear_solver(options);
  const auto make = [options]() -> std::unique_ptr<LinearSolver> {
    if (options.condense) return std::make_unique<CondensedSolver>(options);
    return make_linear_solver(options);
  };
  if (parallel::size() > 1) return make();
  return std::make_unique<SeparatedSolver>(make);
}

}  // namespace sprekk
