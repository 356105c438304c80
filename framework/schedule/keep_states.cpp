// After a solution in which cells have left their discrete states by a jump, or have lost strength: looks for the
// solution to which small increments from the start of the step lead.
#include <algorithm>
#include <map>
#include <utility>

#include "framework/invariants.hpp"
#include "framework/linear/condensed_eigenpair.hpp"
#include "framework/schedule/newton.hpp"
#include "framework/schedule/search_mode_guard.hpp"

namespace sprekk {

int Newton::keep_states(const StepTime& step, const std::vector<Vector>& start) {
  int kept = 0, iterations = 0;
  for (Part* part : parts_) kept += part->keep_states();
  if (kept == 0) return 0;
  const std::vector<Vector> found = values();
  set(start);
  while (true) {
    const StepStatus tried = attempt(step, options_.undamped, Until::search);
    iterations += tried.iterations;
    int released = 0;
    if (tried.converged)
      for (Part* part : parts_) released += part->release_violated();
    if (tried.converged && released == 0) break;
    kept -= released;
    if (tried.converged && kept > 0) continue;
    set(found);
    iterations = 0;
    break;
  }
  for (Part* part : parts_) part->release_kept();
  return iterations;
}

std::optional<Newton::Loss> Newton::find_loss(double time) {
  struct Free {
    const Softening* part;
    FreeValues values;
  };
  std::vector<Free> free;
  CondensedUnknowns condensed;
  std::vector<double> factors;
  const auto place = [&](const Field* field) {
    return std::find(unknowns_.begin(), unknowns_.end(), field) - unknowns_.begin();
  };
  for (const Part* part : parts_) {
    const auto* softening = dynamic_cast<const Softening*>(part);
    if (!softening) continue;
    FreeValues values = softening->free_values();
    const auto row = place(values.row), column = place(values.column), all = std::ssize(unknowns_);
    if (row == all || column == all) continue;
    for (const int value : values.values) {
      condensed.rows.push_back(system_.first(static_cast<int>(row)) + value);
      condensed.columns.push_back(system_.first(static_cast<int>(column)) + value);
    }
    factors.insert(factors.end(), values.factors.begin(), values.factors.end());
    free.push_back({softening, std::move(values)});
  }
  condensed.factors = Eigen::Map<const Vector>(factors.data(), std::ssize(factors));
  const std::optional<CondensedEigenpair> pair =
      negative_eigenpair(*linear_, system_.rows(), system_.size(), condensed);
  if (!pair) return std::nullopt;
  std::optional<Loss> loss;
  double most = 0;
  Eigen::Index first = 0;
  for (Free& part : free) {
    const Vector motion = pair->vector.segment(first, std::ssize(part.values.values));
    first += motion.size();
    if (motion.norm() <= most) continue;
    most = motion.norm();
    loss = {part.part, time, part.part->tell_loss({time, pair->value, std::move(part.values.values), motion})};
  }
  return loss;
}

std::optional<Newton::Loss> Newton::find_loss(const StepTime& step, double time) {
  std::optional<Loss> loss = find_loss(time);
  if (!loss) return loss;
  // What flows away takes time, and may hold up a motion that would run away over a longer step.
  constexpr double shortest = 1e-6;  // of the step
  const double dt = shortest * step.dt;
  const ResidualCheck check = evaluate({step.end - dt, dt, step.end});
  const bool is_factored = check.finite && linear_->factor(system_.matrix(*assembly_)).solved;
  if (!is_factored || !find_loss(time)) loss.reset();
  if (loss) return loss;
  evaluate(step);
  linear_->factor(system_.matrix(*assembly_));
  return std::nullopt;
}

void Newton::follow_softening(const StepTime& step) {
  const bool has_softened = std::ranges::any_of(parts_, [&](const Part* part) {
    const auto* softening = dynamic_cast<const Softening*>(part);
    return softening && std::ranges::count(unknowns_, softening->free_values().column) > 0 && softening->has_softened();
  });
  if (!has_softened || options_.pieces == 0) return;
  const std::vector<Vector> found = values();
  std::vector<Vector> accepted;
  for (const Field* field : unknowns_) accepted.push_back(field->accepted());
  StepStatus path;
  const IterationLog log = std::exchange(log_, {});
  {
    const SearchModeGuard guard(SearchMode::piecewise, SearchMode::with_shortcuts, parts_);
    set(accepted);
    path = follow_path(step, SearchMode::piecewise);
  }
  if (lost_) {
    passed_ = lost_;
    passed_in_ = step;
  }
  const bool leads_elsewhere = path.converged && is_elsewhere(found);
  if (!leads_elsewhere || !attempt(step, options_.undamped).converged) {
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
