#include "framework/schedule/newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "framework/invariants.hpp"
#include "framework/parallel/interruption.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/schedule/residual_check.hpp"
#include "framework/schedule/search_mode_guard.hpp"

namespace sprekk {

Newton::Newton(const Mesh& mesh, std::vector<Field*> unknowns, std::vector<Part*> parts, const LinearOptions& linear,
               const NewtonOptions& options, std::string name, IterationLog log)
    : unknowns_(std::move(unknowns)),
      parts_(std::move(parts)),
      pieces_(parts_with<PiecewiseSmooth>(parts_)),
      options_(options),
      name_(std::move(name)),
      log_(std::move(log)),
      system_(mesh, {unknowns_.begin(), unknowns_.end()}),
      linear_(make_condensing_solver(linear)) {
  system_.use_sums(is_direct(linear, system_.size()));
  SPREKK_EXPECT(options_.residual > 0 && options_.update > 0, options_.residual, options_.update);
  SPREKK_EXPECT(options_.at_most > 0, options_.at_most);
}

Newton::~Newton() = default;

void Newton::set_preconditioner_stabilization(const Stabilization& stabilization) {
  for (const auto& [field, diagonal] : stabilization) system_.set_stabilization(*field, diagonal);
}

std::unique_ptr<Assembly> Newton::assemble(const StepTime& step) {
  ++assemblies_;
  for (PiecewiseSmooth* part : pieces_) part->observe_iterate(unknowns_);
  auto assembly = std::make_unique<Assembly>(std::vector<const Field*>{unknowns_.begin(), unknowns_.end()},
                                             Assembly::Request::residual_and_derivatives, &products_);
  for (const Part* part : parts_) part->assemble(*assembly, step);
  if (stabilization_)
    for (const auto& [field, diagonal] : *stabilization_) {
      if (!assembly->has_row(*field)) continue;
      SPREKK_EXPECT(diagonal.size() == field->size(), field->name(), diagonal.size(), field->size());
      SPREKK_ASSERT(start_.count(field) == 1, field->name());
      assembly->add(*field, diagonal.cwiseProduct(field->now() - start_.at(field)));
      assembly->diagonal(*field, *field, diagonal);
    }
  if (responses_) add_responses(*assembly, *responses_, start_);
  for (const Part* part : parts_) part->constrain(*assembly);
  return assembly;
}

LinearCounts Newton::counts() const {
  LinearCounts counts = linear_->counts();
  counts.patterns = system_.patterns_built();
  counts.assemblies = assemblies_;
  return counts;
}

std::uint64_t Newton::discrete_state() const {
  std::uint64_t state = 0;
  for (const PiecewiseSmooth* part : pieces_) state = state * 1000003 + part->discrete_state();
  return state;
}

std::vector<Vector> Newton::values() const {
  std::vector<Vector> values;
  for (const Field* field : unknowns_) values.push_back(field->now());
  return values;
}

void Newton::set(const std::vector<Vector>& values) {
  SPREKK_EXPECT(values.size() == unknowns_.size(), values.size(), unknowns_.size());
  for (std::size_t u = 0; u < unknowns_.size(); ++u) unknowns_[u]->set(values[u]);
}

void Newton::move(const std::vector<Vector>& from, const Vector& update, double length) {
  SPREKK_EXPECT(from.size() == unknowns_.size(), from.size(), unknowns_.size());
  SPREKK_EXPECT(update.size() == system_.size(), update.size(), system_.size());
  SPREKK_EXPECT(std::isfinite(length), length);
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    const auto part = update.segment(system_.first(static_cast<int>(u)), unknowns_[u]->size());
    if (!part.isZero(0)) unknowns_[u]->set(from[u] + length * part);  // else it keeps its values
  }
}

Vector Newton::right_hand_side(const ResidualCheck& check) const {
  Vector right = -system_.residual(*assembly_);
  SPREKK_EXPECT(check.is_round_off.size() == unknowns_.size(), check.is_round_off.size(), unknowns_.size());
  const std::vector<int>& rows = system_.rows();
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    // Rows whose residuals are round-off are left alone, but not where their sum still has to be found.
    if (!check.is_round_off[u] || check.is_unbalanced[u] || !check.is_round_off_in_sum[u]) continue;
    const int first = system_.first(static_cast<int>(u)), end = first + unknowns_[u]->size();
    const auto begin = std::lower_bound(rows.begin(), rows.end(), first);
    right.segment(begin - rows.begin(), std::lower_bound(begin, rows.end(), end) - begin).setZero();
  }
  for (const BalanceSums::Replaced& sum : system_.sums().replaced()) {
    double total = 0;
    for (const int u : sum.quantity.unknowns)
      if (!check.is_round_off[u] || !check.is_round_off_in_sum[u] || check.is_unbalanced[u])
        total += system_.residual_of_sum(*assembly_, u);
    if (sum.place >= 0) right[sum.place] = -total;
    SPREKK_ASSERT(sum.place < right.size(), sum.place, right.size());
  }
  return right;
}

std::vector<char> Newton::is_settled(const ResidualCheck& check) const {
  std::vector<char> settled(unknowns_.size(), 0);
  if (!check.finite) return settled;
  settled = check.is_round_off;
  for (const Balances::Quantity& quantity : assembly_->balances().quantities()) {
    const bool holds = std::ranges::all_of(quantity.unknowns, [&](int u) { return check.is_round_off_in_sum[u]; });
    for (const int unknown : quantity.unknowns) settled[unknown] = settled[unknown] && holds;
  }
  return settled;
}

double Newton::relative_size(const Vector& update, const ResidualCheck& check) const {
  SPREKK_EXPECT(update.size() == system_.size(), update.size(), system_.size());
  // Fields of one unit share a scale: a jump that is zero while everything sticks is compared with the displacements.
  std::map<std::string, double> scale, change;
  const std::vector<char> settled = is_settled(check);
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    const Field& field = *unknowns_[u];
    if (field.size() == 0) continue;
    double& s = scale[field.spec().unit];
    // A field may become zero: its change is then compared with its former values.
    s = std::max({s, field.now().lpNorm<Eigen::Infinity>(), field.accepted().lpNorm<Eigen::Infinity>()});
    if (settled[u]) continue;
    double& c = change[field.spec().unit];
    c = std::max(c, update.segment(system_.first(static_cast<int>(u)), field.size()).lpNorm<Eigen::Infinity>());
  }
  double largest = 0;
  for (const auto& [unit, size] : change)
    if (scale[unit] > 0) largest = std::max(largest, size / scale[unit]);
  return largest;
}

namespace {

/// The largest merit of the last three states, in the scales of the last one.
double merit_bound(const std::vector<ResidualCheck>& recent) {
  double bound = 0;
  for (const ResidualCheck& check : recent) bound = std::max(bound, check.merit(recent.back()));
  return bound;
}

}  // namespace

ResidualCheck Newton::take_step(const StepTime& step, const Vector& update, bool ask_for_descent, double& length) {
  SPREKK_EXPECT(is_finite(update), update.size());
  SPREKK_EXPECT(!recent_.empty());
  const std::vector<Vector> from = values();
  ResidualCheck best;
  double best_length = 0, best_merit = 0;
  const double bound = merit_bound(recent_);
  constexpr double sufficient = 1e-4;              // of the descent that the derivatives predict (Armijo 1966)
  constexpr int for_descent = 6, for_finite = 12;  // halvings
  length = 1;
  for (int halvings = 0; halvings < (ask_for_descent ? for_descent : for_finite); ++halvings, length /= 2) {
    move(from, update, length);
    const ResidualCheck check = evaluate(step);
    const double merit = check.merit(recent_.back());
    if (check.finite && (best_length == 0 || merit < best_merit)) {
      best_merit = merit;
      best = check;
      best_length = length;
    }
    if (!check.finite) continue;
    if (!ask_for_descent || check.converged || merit < (1 - sufficient * length) * bound) break;
  }
  if (best_length == 0) {
    best.finite = false;
    return best;
  }
  if (length != best_length) {
    move(from, update, best_length);
    best = evaluate(step);
  }
  length = best_length;
  return best;
}

ResidualCheck Newton::evaluate(const StepTime& step) {
  interruption::poll();
  assembly_ = assemble(step);
  return check_residual(*assembly_, system_, options_.residual);
}

StepStatus Newton::solve(const StepTime& step, const Stabilization& stabilization, const Responses& responses) {
  SPREKK_EXPECT(step.dt > 0 && std::isfinite(step.end), step.start, step.dt, step.end);
  SPREKK_EXPECT(std::ranges::all_of(unknowns_, [](const Field* field) { return is_finite(field->now()); }));
  stabilization_ = &stabilization;
  responses_ = &responses;
  products_.forget_unused();
  system_.use_coupled_sums(false);
  start_.clear();
  for (const auto& [field, diagonal] : stabilization) start_[field] = field->now();
  for (const ResponseTerm& response : responses.terms) start_[response.column] = response.column->now();
  const std::vector<Vector> start = values();
  StepStatus status = search(step, start);
  // The larger number of iterations is the measure for adaptive steps; with the sum, steps would become shorter.
  if (status.converged) status.iterations = std::max(status.iterations, keep_states(step, start));
  if (passed_ && step.start <= passed_in_.start && step.end <= passed_in_.end) passed_.reset();
  if (status.converged) follow_softening(step);
  return status;
}

void Newton::note_step(Notes& notes, const StepTime& step) const {
  if (passed_ && passed_in_.start >= step.start) passed_->part->note_passed(passed_->told, notes);
}

StepStatus Newton::search(const StepTime& step, const std::vector<Vector>& start) {
  state_has_changed_ = false;
  // If the system is singular, because nothing holds some unknown in the present discrete state, a further attempt
  // starts from fields whose conditions are inactive (PiecewiseSmooth::deactivate_conditions).
  int iterations = 0;
  const auto attempt_also_without_conditions = [&](Until until) {
    StepStatus tried = attempt(step, options_.undamped, until);
    iterations += tried.iterations;
    if (!tried.converged && was_singular_) {
      set(start);
      for (PiecewiseSmooth* part : pieces_) part->deactivate_conditions();
      tried = attempt(step, options_.undamped, until);
      iterations += tried.iterations;
    }
    tried.iterations = iterations;
    return tried;
  };
  StepStatus status = attempt_also_without_conditions(Until::search);
  if (status.converged) return status;
  const bool is_nonlinear =
      std::ranges::any_of(pieces_, [](const PiecewiseSmooth* part) { return part->is_nonlinear_in_pieces(); });
  const SearchModeGuard guard(SearchMode::without_shortcuts, SearchMode::with_shortcuts, pieces_);
  // Without shortcuts such parts come near the solution surely and slowly. From there their own derivatives are quick.
  const auto finish_with_own_derivatives = [&] {
    if (status.converged || !is_nonlinear || !is_used_up_) return;
    const SearchModeGuard own(SearchMode::piecewise, SearchMode::without_shortcuts, pieces_);
    StepStatus finished = attempt(step, options_.undamped);
    finished.iterations += status.iterations;
    status = finished;
  };
  if (was_left_) {
    set(start);
    status = attempt_also_without_conditions(Until::end);
    finish_with_own_derivatives();
  }
  if (status.converged) return status;
  if (status.iterations <= 1) return status;
  if (options_.undamped > 0) {
    set(start);
    const int before = status.iterations;
    status = attempt(step, 0);
    status.iterations += before;
    finish_with_own_derivatives();
  }
  if (status.converged || !(state_has_changed_ || is_nonlinear) || options_.pieces == 0) return status;
  const bool is_used_up = is_used_up_;
  const std::vector<Vector> tried = values();
  constexpr double much_shorter = 1.0 / 2;
  const bool has_failed = last_failed_path_.dt > 0 && step.start == last_failed_path_.start;
  if (has_failed && step.dt > much_shorter * last_failed_path_.dt) return status;
  for (const SearchMode mode : {SearchMode::piecewise_linear, SearchMode::piecewise}) {
    set(start);
    StepStatus path = follow_path(step, mode);
    status.iterations += path.iterations;
    if (lost_ && mode == SearchMode::piecewise) {
      status.reason = lost_->told;
      status.lost_at = lost_->time;
      status.is_hopeless = least_iterations_ == 0;  // in an iteration other unknowns are held
      break;
    }
    // Iterates from the end of the path with the true coefficients, until balances hold.
    if (path.converged) {
      const std::vector<Vector> end = values();
      path = attempt(step, options_.undamped);
      status.iterations += path.iterations;
      if (!path.converged && mode == SearchMode::piecewise_linear) {
        const std::string reason = path.reason;
        set(end);
        path = release_coefficients(step, start);
        path.reason = reason + "; then " + path.reason;
        status.iterations += path.iterations;
      }
    }
    if (path.converged) return {true, "", status.iterations};
    status.reason += "; then " + path.reason;
    if (is_path_stuck_) break;  // with other derivatives its pieces are the same
  }
  last_failed_path_ = step;
  if (is_used_up) set(tried);
  is_used_up_ = is_used_up;
  return status;
}

bool Newton::take_coupled_sums(ResidualCheck& check) {
  if (!system_.sums().are_used || system_.sums().are_used_where_coupled) return false;
  system_.use_coupled_sums(true);
  const std::vector<char> seeks_balance = check.is_unbalanced;
  check = check_residual(*assembly_, system_, options_.residual);
  check.is_unbalanced = seeks_balance;
  return true;
}

StepStatus Newton::attempt(const StepTime& step, int undamped, Until until) {
  was_singular_ = was_left_ = is_used_up_ = false;
  std::multiset<std::uint64_t> seen_states;
  std::uint64_t last_state = 0;
  bool factored = false, cycling = false, seeks_balance = false;
  double length = 1, last_imbalance = std::numeric_limits<double>::infinity(), last_row_error = last_imbalance;
  ResidualCheck check = evaluate(step);
  recent_ = {check};
  if (log_) log_({step, name_, 0, check.largest, check.equation, 0, 1, check.of_equations});
  for (int iteration = 0;; ++iteration) {
    if (!check.finite) return {false, "the residual of " + check.equation + " is not finite", iteration};
    // As long as other equations do not hold, balances are not checked, and round-off of rows of the bulk needs no
    // back-solve.
    seeks_balance = seeks_balance || (check.rows_hold && !check.balances_hold);
    if (!seeks_balance) check.is_unbalanced.assign(check.is_unbalanced.size(), 0);
    bool holds = check.converged && iteration >= least_iterations_;
    if (check.rows_hold && !check.converged && factored) {
      // An imbalance that another iteration does not reduce is lost in the round-off of the matrix. Sums of balances
      // may remove it; otherwise no smaller imbalance is possible. The same for the residual of a single row.
      constexpr double hardly_better = 0.5;
      holds = check.each_row_holds || check.row_error > hardly_better * last_row_error;
      last_row_error = check.row_error;
      if (!check.balances_hold) {
        const bool stalls = check.imbalance > hardly_better * last_imbalance;
        last_imbalance = check.imbalance;
        if (stalls && system_.sums().are_used && !system_.sums().are_used_where_coupled) {
          system_.use_coupled_sums(true);
          holds = false;
        }
        holds = holds && stalls;
      }
    }
    if (holds) {
      const std::vector<char> settled = is_settled(check);
      const bool is_exact = std::all_of(settled.begin(), settled.end(), [](char c) { return c; });
      if (!factored || is_exact) return {true, "", iteration};
      // The simplified update: the change by one more iteration, at the cost of a back-solve.
      Vector update;
      const LinearReport report = linear_->solve(right_hand_side(check), update);
      const double size = report.solved ? relative_size(update, check) : std::numeric_limits<double>::infinity();
      if (log_) log_({step, name_, iteration, check.largest, check.equation, size, 0, check.of_equations});
      if (size <= options_.update) return {true, "", iteration};
    }
    is_used_up_ = iteration == options_.at_most;
    if (is_used_up_)
      return {false,
              fmt::format("no convergence in {} iterations (the residual of {} is {:.2g} of its terms)", iteration,
                          check.equation, check.largest),
              iteration};

    if (iteration == 0)
      if (const std::string floating = system_.describe_floating(*assembly_); !floating.empty()) {
        was_singular_ = true;
        StepStatus status{false, "singular system: " + floating, 0};
        status.is_hopeless = true;
        return status;
      }
    LinearReport factoring = linear_->factor(system_.matrix(*assembly_));
    if (!factoring.solved && take_coupled_sums(check)) factoring = linear_->factor(system_.matrix(*assembly_));
    if (!factoring.solved) {
      was_singular_ = true;
      return {false, "singular system: " + factoring.reason, iteration};
    }
    factored = true;
    Vector update;
    LinearReport report = linear_->solve(right_hand_side(check), update);
    if (!report.solved && take_coupled_sums(check) && linear_->factor(system_.matrix(*assembly_)).solved)
      report = linear_->solve(right_hand_side(check), update);
    if (!report.solved) return {false, "linear solver: " + report.reason, iteration};
    SPREKK_ASSERT(update.size() == system_.size(), update.size(), system_.size());

    // A cycle is a discrete state that is left and returns repeatedly. A state that stays is no cycle.
    const std::uint64_t state = discrete_state();
    if (iteration == 0 || state != last_state) {
      cycling = cycling || seen_states.count(state) > 1;
      state_has_changed_ = state_has_changed_ || iteration > 0;
      seen_states.insert(state);
      last_state = state;
    }
    const bool searches = cycling || iteration > undamped || undamped == 0;
    if (searches && until == Until::search && undamped > 0 && state_has_changed_) {
      was_left_ = true;
      return {false, "the discrete state does not settle", iteration};
    }
    check = take_step(step, update, searches, length);
    recent_.push_back(check);
    constexpr std::size_t remembered = 3;  // states in the bound of a line search (Grippo and others 1986)
    if (recent_.size() > remembered) recent_.erase(recent_.begin());
    if (log_)
      log_({step, name_, iteration + 1, check.largest, check.equation, relative_size(update, check), length,
            check.of_equations});
  }
}

}  // namespace sprekk
