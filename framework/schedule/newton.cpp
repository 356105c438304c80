#include "framework/schedule/newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "framework/assembly/assemble_all.hpp"
#include "framework/config/state.hpp"
#include "framework/invariants.hpp"
#include "framework/parallel/interruption.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/schedule/residual_check.hpp"

namespace sprekk {
namespace {

/// In space columns cost as much as some factorizations, which only pieces need: a linear problem has one system.
LinearOptions in_pieces(LinearOptions linear, bool has_pieces) {
  if (dimension == 3 && !has_pieces) linear.condense = false;
  return linear;
}

}  // namespace

Newton::Newton(const Mesh& mesh, std::vector<Field*> unknowns, std::vector<Part*> parts, const LinearOptions& linear,
               const NewtonOptions& options, std::string name, IterationLog log)
    : unknowns_(std::move(unknowns)),
      parts_(std::move(parts)),
      pieces_(parts_with<PiecewiseSmooth>(parts_)),
      options_(options),
      name_(std::move(name)),
      log_(std::move(log)),
      system_(mesh, {unknowns_.begin(), unknowns_.end()}),
      linear_(make_condensing_solver(in_pieces(linear, !pieces_.empty()))) {
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
  follow_state(parts_, *assembly);
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
    // The right-hand side of rows whose residuals are round-off is zero, unless their sum still has to be solved for.
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
  constexpr int for_descent = 6, for_finite = 12;  // halvings: to 1/64, or to 1/4096
  length = 1;
  for (int halvings = 0; halvings < (ask_for_descent ? for_descent : for_finite); ++halvings, length /= 2) {
    move(from, update, length);
    const ResidualCheck check = evaluate_trial(step);
    const double merit = check.merit(recent_.back());
    if (!check.finite) best.without_value = check.without_value;
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

ResidualCheck Newton::evaluate_trial(const StepTime& step) {
  try {
    return evaluate(step);
  } catch (const StateError& error) {
    ResidualCheck check;
    check.finite = false;
    check.without_value = error.what();
    return check;
  }
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

bool Newton::may_take_coupled_sums() const { return system_.sums().are_used && !system_.sums().are_used_where_coupled; }

bool Newton::take_coupled_sums(ResidualCheck& check) {
  if (!may_take_coupled_sums()) return false;
  system_.use_coupled_sums(true);
  const std::vector<char> seeks_balance = check.is_unbalanced;
  check = check_residual(*assembly_, system_, options_.residual);
  check.is_unbalanced = seeks_balance;
  return true;
}

/// What an attempt has seen so far.
struct Newton::Seen {
  bool seeks_balance = false;  ///< in an iterate all rows held, but the balances did not
  bool has_factors = false;
  double last_imbalance = std::numeric_limits<double>::infinity(), last_row_error = last_imbalance;
  std::multiset<std::uint64_t> states;  ///< one for each time that a discrete state was entered
  std::uint64_t last_state = 0;
  bool is_cycling = false;

  /// False for the first state, and for the one before.
  bool take(std::uint64_t state) {
    if (!states.empty() && state == last_state) return false;
    const bool is_change = !states.empty();
    // A cycle is a discrete state that is left and returns repeatedly. A state that stays is no cycle.
    is_cycling = is_cycling || states.count(state) > 1;
    states.insert(state);
    last_state = state;
    return is_change;
  }
};

/// Whether the residual of an iterate is as small as it has to be, or can be.
bool Newton::is_small(ResidualCheck& check, int iteration, Seen& seen) {
  // As long as other equations do not hold, balances are not checked, and round-off of rows of the bulk needs no
  // back-solve.
  seen.seeks_balance = seen.seeks_balance || (check.rows_hold && !check.balances_hold);
  if (!seen.seeks_balance) check.is_unbalanced.assign(check.is_unbalanced.size(), 0);
  if (!check.rows_hold || check.converged || !seen.has_factors)
    return check.converged && iteration >= least_iterations_;
  // An imbalance that an iteration does not halve is round-off of the matrix. Sums of balances may remove it; otherwise
  // it cannot be reduced. The same holds for the residual of a single row.
  const bool rows_stall = check.each_row_holds || check.row_error > 0.5 * seen.last_row_error;
  seen.last_row_error = check.row_error;
  if (check.balances_hold) return rows_stall;
  const bool stalls = check.imbalance > 0.5 * seen.last_imbalance;
  seen.last_imbalance = check.imbalance;
  if (stalls && may_take_coupled_sums()) {
    system_.use_coupled_sums(true);
    return false;
  }
  return rows_stall && stalls;
}

/// Whether the next update would be small as well: the simplified one, which costs a back-solve.
bool Newton::is_settled_solution(const StepTime& step, const ResidualCheck& check, int iteration, bool has_factors) {
  if (!has_factors || std::ranges::all_of(is_settled(check), [](char settled) { return settled != 0; })) return true;
  Vector update;
  const LinearReport report = linear_->solve(right_hand_side(check), update);
  const double size = report.solved ? relative_size(update, check) : std::numeric_limits<double>::infinity();
  if (log_) log_({step, name_, iteration, check.largest, check.equation, size, 0, check.of_equations});
  return size <= options_.update;
}

/// The next update, or why there is none.
std::string Newton::find_update(ResidualCheck& check, Vector& update) {
  LinearReport report = linear_->factor(system_.matrix(*assembly_));
  if (!report.solved && take_coupled_sums(check)) report = linear_->factor(system_.matrix(*assembly_));
  was_singular_ = !report.solved;
  if (was_singular_) return "singular system: " + report.reason;
  report = linear_->solve(right_hand_side(check), update);
  if (!report.solved && take_coupled_sums(check) && linear_->factor(system_.matrix(*assembly_)).solved)
    report = linear_->solve(right_hand_side(check), update);
  was_singular_ = !report.solved;  // or so near to it that its solution means nothing
  return report.solved ? "" : "linear solver: " + report.reason;
}

StepStatus Newton::iterate(const StepTime& step, int undamped, Until until) {
  was_singular_ = was_left_ = is_used_up_ = false;
  Seen seen;
  ResidualCheck check = evaluate(step);
  recent_ = {check};
  if (log_) log_({step, name_, 0, check.largest, check.equation, 0, 1, check.of_equations});
  for (int iteration = 0;; ++iteration) {
    const auto fails = [iteration](std::string reason) { return StepStatus{false, std::move(reason), iteration}; };
    if (!check.finite) return fails(check.why_not_finite());
    if (is_small(check, iteration, seen) && is_settled_solution(step, check, iteration, seen.has_factors))
      return {true, "", iteration};
    is_used_up_ = iteration == options_.at_most;
    if (is_used_up_)
      return fails(fmt::format("no convergence in {} iterations (the residual of {} is {:.2g} of its terms)", iteration,
                               check.equation, check.largest));
    if (const std::string floating = iteration == 0 ? system_.describe_floating(*assembly_) : ""; !floating.empty()) {
      was_singular_ = true;
      StepStatus status = fails("singular system: " + floating);
      status.is_hopeless = true;
      return status;
    }
    Vector update;
    if (std::string failure = find_update(check, update); !failure.empty()) return fails(std::move(failure));
    seen.has_factors = true;
    SPREKK_ASSERT(update.size() == system_.size(), update.size(), system_.size());
    if (seen.take(discrete_state())) state_has_changed_ = true;
    const bool searches = seen.is_cycling || iteration > undamped || undamped == 0;
    if (searches && until == Until::search && undamped > 0 && state_has_changed_) {
      was_left_ = true;
      return fails("the discrete state does not settle");
    }
    double length = 1;
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
