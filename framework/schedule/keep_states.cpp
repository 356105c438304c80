// After a solution in which cells have left their discrete states by a jump, or have lost strength: searches for the
// solution that follows from the start of the step by small increments.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "framework/invariants.hpp"
#include "framework/round_off.hpp"
#include "framework/schedule/newton.hpp"
#include "framework/schedule/search_mode_guard.hpp"

namespace sprekk {

namespace {

void append(CondensedUnknowns& all, const CondensedUnknowns& more) {
  all.rows.insert(all.rows.end(), more.rows.begin(), more.rows.end());
  all.columns.insert(all.columns.end(), more.columns.begin(), more.columns.end());
  Vector factors(all.factors.size() + more.factors.size());
  factors << all.factors, more.factors;
  all.factors = std::move(factors);
}

}  // namespace

int Newton::keep_states(const StepTime& step, const std::vector<Vector>& start) {
  int kept = 0, iterations = 0;
  for (PiecewiseSmooth* part : pieces_) kept += part->keep_states();
  if (kept == 0) return 0;
  const std::vector<Vector> found = values();
  set(start);
  while (true) {
    const StepStatus tried = iterate(step, options_.undamped, Until::search);
    iterations += tried.iterations;
    int released = 0;
    if (tried.converged)
      for (PiecewiseSmooth* part : pieces_) released += part->release_violated();
    if (tried.converged && released == 0) break;
    kept -= released;
    if (tried.converged && kept > 0) continue;
    set(found);
    iterations = 0;
    break;
  }
  for (PiecewiseSmooth* part : pieces_) part->release_kept();
  return iterations;
}

std::optional<CondensedUnknowns> Newton::condensed_to(const FreeValues& values) const {
  const auto place = [&](const Field* field) {
    return static_cast<int>(std::find(unknowns_.begin(), unknowns_.end(), field) - unknowns_.begin());
  };
  const int row = place(values.row), column = place(values.column), all = static_cast<int>(unknowns_.size());
  if (row == all || column == all) return std::nullopt;
  CondensedUnknowns unknowns;
  for (const int value : values.values) {
    unknowns.rows.push_back(system_.first(row) + value);
    unknowns.columns.push_back(system_.first(column) + value);
  }
  unknowns.factors = values.factors;
  return unknowns;
}

std::optional<Newton::Loss> Newton::find_loss(double time) {
  std::vector<std::pair<Softening*, FreeValues>> free;
  CondensedUnknowns all;
  for (Part* part : parts_) {
    auto* softening = dynamic_cast<Softening*>(part);
    if (!softening) continue;
    FreeValues values = softening->free_values();
    const std::optional<CondensedUnknowns> unknowns = condensed_to(values);
    if (!unknowns) continue;
    append(all, *unknowns);
    free.emplace_back(softening, std::move(values));
  }
  const std::optional<CondensedEigenpair> pair = negative_eigenpair(*linear_, system_.rows(), system_.size(), all);
  if (!pair) return std::nullopt;
  std::optional<Loss> loss;
  double most = 0;
  Eigen::Index first = 0;
  for (auto& [part, values] : free) {
    const Vector motion = pair->vector.segment(first, std::ssize(values.values));
    first += motion.size();
    if (motion.norm() <= most) continue;
    most = motion.norm();
    loss = {part, time, part->tell_loss({time, pair->value, std::move(values.values), motion})};
  }
  return loss;
}

std::optional<Newton::Loss> Newton::find_loss(const StepTime& step, double time) {
  std::optional<Loss> loss = find_loss(time);
  if (!loss) return loss;
  // What flows away takes time, and may hold up a motion that would run away over a longer step.
  const double dt = rounding::far_above * step.dt;
  const ResidualCheck check = evaluate({step.end - dt, dt, step.end});
  const bool is_factored = check.finite && linear_->factor(system_.matrix(*assembly_)).solved;
  if (!is_factored || !find_loss(time)) loss.reset();
  if (loss) return loss;
  evaluate(step);
  linear_->factor(system_.matrix(*assembly_));
  return std::nullopt;
}

bool Newton::may_have_passed_loss(const StepTime& step) {
  CondensedUnknowns softened;
  double spent = 0;
  for (const Part* part : parts_) {
    const auto* softening = dynamic_cast<const Softening*>(part);
    if (!softening) continue;
    const Softened of_part = softening->softened();
    const std::optional<CondensedUnknowns> unknowns = condensed_to(of_part.values);
    if (!unknowns) continue;
    append(softened, *unknowns);
    spent = std::max(spent, of_part.spent);
  }
  if (softened.rows.empty() || std::isinf(spent)) return spent > 0;
  // Earlier in the step fewer places move, and each weakens at most as fast as at the end, or by `spent` (places whose
  // strength is used up). So if the smallest stiffness at the end exceeds `spent`, it was positive during the whole
  // step.
  const ResidualCheck check = evaluate(step);
  if (!check.finite || !linear_->factor(system_.matrix(*assembly_)).solved) return true;
  return smallest_if_positive(*linear_, system_.rows(), system_.size(), softened) <= spent;
}

void Newton::follow_softening(const StepTime& step) {
  if (options_.pieces == 0 || !may_have_passed_loss(step)) return;
  const std::vector<Vector> found = values();
  std::vector<Vector> accepted;
  for (const Field* field : unknowns_) accepted.push_back(field->accepted());
  StepStatus path;
  const IterationLog log = std::exchange(log_, {});
  {
    const SearchModeGuard guard(SearchMode::piecewise, SearchMode::with_shortcuts, pieces_);
    set(accepted);
    path = follow_path(step, SearchMode::piecewise);
  }
  if (lost_) {
    passed_ = lost_;
    passed_in_ = step;
  }
  const bool leads_elsewhere = path.converged && is_elsewhere(found);
  if (!leads_elsewhere || !iterate(step, options_.undamped).converged) {
    set(found);
    evaluate(step);
  }
  log_ = log;
}

bool Newton::is_elsewhere(const std::vector<Vector>& solution) const {
  constexpr double elsewhere = 1e-4;  // of the largest value: a path ends within the tolerance of an update
  std::map<std::string, double> scale, difference;
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    const Field& field = *unknowns_[u];
    if (field.size() == 0) continue;
    double &s = scale[field.spec().unit], &d = difference[field.spec().unit];
    s = std::max({s, field.now().lpNorm<Eigen::Infinity>(), solution[u].lpNorm<Eigen::Infinity>()});
    d = std::max(d, (field.now() - solution[u]).lpNorm<Eigen::Infinity>());
  }
  return std::ranges::any_of(difference, [&](const auto& of) { return of.second > elsewhere * scale[of.first]; });
}

}  // namespace sprekk
