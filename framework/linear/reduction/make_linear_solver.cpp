#include <algorithm>
#include <stdexcept>

#include "framework/invariants.hpp"
#include "framework/linear/direct/mumps_solver.hpp"
#include "framework/linear/direct/umfpack_solver.hpp"
#include "framework/linear/iterative/belos_solver.hpp"
#include "framework/linear/last_system.hpp"
#include "framework/linear/linear_solver.hpp"
#include "framework/linear/reduction/condensed_solver.hpp"
#include "framework/linear/reduction/separated_solver.hpp"
#include "framework/linear/reduction/summed_balances.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

/// Chooses a solver for the first system, and again when the number of unknowns crosses a limit. A direct solver is
/// accurate to rounding error, and in two dimensions faster up to some hundred thousand unknowns; above, its memory is
/// the limit. A system for which GMRES does not converge is solved directly, up to a second limit.
class AutomaticSolver final : public LinearSolver {
 public:
  explicit AutomaticSolver(const LinearOptions& options) : options_(options) {}

  LinearReport factor(const LinearSystem& system) override {
    LinearSolver& solver = chosen_for(system);
    if (solver.name() != "belos" || !can_be_direct(system)) {
      forget_system();
      return solver.factor(system);
    }
    const bool is_known =
        system_ && ((system.number != 0 && system.number == number_) || have_same_bits(*system_, system));
    if (parallel::any(!is_known)) keep(system);
    number_ = system.number;
    return is_solved_directly_ ? instead_->factor(*system_) : or_directly(solver.factor(*system_));
  }
  std::optional<LinearReport> factor_bordered(const LinearSystem& system, const SparseMatrix& columns,
                                              const SparseMatrix& rows, Eigen::MatrixXd& schur) override {
    return chosen_for(system).factor_bordered(system, columns, rows, schur);
  }
  LinearReport solve(const Vector& b_rows, Vector& x) override {
    if (!chosen_) return LinearReport::failure("solve was called before factor");
    if (is_solved_directly_) return instead_->solve(b_rows, x);
    const LinearReport report = chosen_->solve(b_rows, x);
    or_directly(report);
    return is_solved_directly_ ? instead_->solve(b_rows, x) : report;
  }
  bool solve_columns(Eigen::Ref<Eigen::MatrixXd> columns) override {
    return chosen_ && chosen_->solve_columns(columns);
  }
  std::string name() const override { return chosen_ ? chosen_->name() : "auto"; }
  const LinearCounts& counts() const override {
    if (!instead_) return chosen_ ? chosen_->counts() : counts_;
    counts_of_both_ = chosen_->counts();
    return counts_of_both_ += instead_->counts();
  }

 private:
  static constexpr int most_iterations_before_it = 100;  // these take a part of the time of a factorization

  bool can_be_direct(const LinearSystem& system) const {
    return system.local.cols() <= options_.largest_for_direct_instead;
  }

  /// The report of GMRES; where it has failed, that of a factorization of the same system, which is used from now on.
  LinearReport or_directly(const LinearReport& report) {
    if (report.solved || !system_) return report;
    if (!instead_) instead_ = std::make_unique<SummedBalances>(std::make_unique<MumpsSolver>());
    const LinearReport direct = instead_->factor(*system_);
    is_solved_directly_ = direct.solved;
    return direct.solved ? direct : report;
  }

  /// Keeps a copy of a new system. Its numbers spare the solvers copies of their own.
  void keep(const LinearSystem& system) {
    const bool has_same_pattern = system_ && have_same_places(*system_, system);
    const std::uint64_t pattern = has_same_pattern ? system_->pattern_number : new_system_number();
    system_ = system;
    system_->pattern_number = pattern;
    system_->number = new_telling_number();
    is_solved_directly_ = false;
  }

  void forget_system() {
    system_.reset();
    is_solved_directly_ = false;
  }

  LinearSolver& chosen_for(const LinearSystem& system) {
    // MUMPS factorizes 1.4 to 2.8 times faster than UMFPACK, but it starts MPI, and a back-solve of few unknowns takes
    // it twice as long.
    constexpr int smallest_for_mumps = 10'000;
    const auto unknowns = system.local.cols();
    const bool is_for_mumps = parallel::size() > 1 || options_.bulk_changes_often || unknowns >= smallest_for_mumps;
    const char* const type = unknowns > options_.largest_for_direct ? "belos" : is_for_mumps ? "mumps" : "umfpack";
    LinearOptions options = options_;
    options.type = type;
    if (can_be_direct(system)) options.max_iterations = std::min(options.max_iterations, most_iterations_before_it);
    if (!chosen_ || chosen_->name() != type || options.max_iterations != most_iterations_) {
      most_iterations_ = options.max_iterations;
      chosen_ = make_linear_solver(options);
    }
    return *chosen_;
  }

  LinearOptions options_;
  std::unique_ptr<LinearSolver> chosen_;
  int most_iterations_ = 0;
  // The last system that GMRES was to solve, and what solves it directly instead. GMRES tries each new system first.
  std::optional<LinearSystem> system_;
  std::uint64_t number_ = 0;  ///< that it came with
  std::unique_ptr<LinearSolver> instead_;
  bool is_solved_directly_ = false;
  mutable LinearCounts counts_of_both_;
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
