#include "framework/schedule/iterate_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "framework/assembly/assemble_all.hpp"
#include "framework/assembly/counts_later.hpp"
#include "framework/assembly/piecewise_smooth.hpp"
#include "framework/assembly/stabilizes.hpp"
#include "framework/invariants.hpp"
#include "framework/schedule/passes/ends_of_passes.hpp"
#include "framework/schedule/passes/pass_changes.hpp"
#include "framework/schedule/passes/round_off_of_values.hpp"
#include "framework/schedule/passes/stalled_acceleration.hpp"

namespace sprekk {

Spec IterateOptions::spec() {
  Spec spec("iterate", "Repeats the steps inside until the coupled residual of all their equations is small.");
  spec.section("until", until.spec(), {.doc = "When the iteration has converged."});
  spec.choice("order", order,
              {{"gauss_seidel", "each step takes what those before it in the pass have found"},
               {"jacobi", "each step takes what the others have found in the pass before"}},
              {.doc = "What the steps of a pass know of one another."});
  spec.choice("fallback", fallback,
              {{"monolithic",
                "it is solved once for all unknowns of the iteration together, which has the answer that passes "
                "converge to; a note says why and in how many steps"},
               {"none", "it is refused, and tried again with a shorter step"}},
              {.doc = "What is done with a time step whose passes do not converge. Passes over substeps have no "
                      "fallback."});
  spec.section("accelerate", acceleration.spec(), {.doc = "Acceleration of the fixed-point iteration."});
  return spec;
}

namespace {

std::vector<Field*> fields_of(const ScheduleStep& inside, const ScheduleContext& context) {
  std::vector<Field*> fields;
  for (const Field* field : inside.unknowns()) fields.push_back(&context.fields.at(field->name()));
  return fields;
}

}  // namespace

IterateStep::IterateStep(const IterateOptions& options, std::unique_ptr<ScheduleStep> inside,
                         const ScheduleContext& context, std::shared_ptr<int> pass)
    : options_(options),
      inside_(std::move(inside)),
      parts_(context.parts),
      fields_(fields_of(*inside_, context)),
      criteria_(options.until, fields_),
      system_(context.mesh, inside_->unknowns()),
      log_(context.log),
      accelerator_(options.acceleration.build()),
      pass_(std::move(pass)) {
  inside_->iterate_with(inside_->unknowns());
  if (options_.fallback == "monolithic" && !options_.has_substeps)
    fallback_.emplace(fields_, options_.newton, options_.linear, context);
  std::vector<std::string> names;
  for (const Field* field : fields_) names.push_back(field->name());
  const std::vector<std::string>& over = options_.acceleration.over;
  for (const std::string& name : over)
    if (!std::ranges::count(names, name))
      throw unknown_name(options_.acceleration.over_origin, "field that is solved inside", name, names);
  for (std::size_t u = 0; u < fields_.size(); ++u)
    if (over.empty() || std::ranges::count(over, names[u])) accelerated_.push_back(u);
  if (!accelerator_ || !context.states) return;
  history_ = fmt::format("iterate.{}.", context.states->size());
  context.states->push_back(this);
}

void IterateStep::accepted() { accelerator_->accepted(); }

void IterateStep::rewound() { accelerator_->rewound(); }

void IterateStep::save(std::map<std::string, Vector>& state) const {
  std::map<std::string, Vector> own;
  accelerator_->save(own);
  for (auto& [name, values] : own) state[history_ + name] = std::move(values);
}

void IterateStep::restore(const std::map<std::string, Vector>& state) {
  std::map<std::string, Vector> own;
  for (const auto& [name, values] : state)
    if (name.starts_with(history_)) own[name.substr(history_.size())] = values;
  accelerator_->restore(own);
}

std::string IterateStep::most_changed(const Vector& change) const {
  std::size_t most = 0;
  const auto size = [&](std::size_t u) {
    return change.segment(system_.first(static_cast<int>(u)), fields_[u]->size()).norm();
  };
  for (std::size_t u = 1; u < fields_.size(); ++u)
    if (size(u) > size(most)) most = u;
  return fields_[most]->name();
}

Vector IterateStep::scaled_values() const {
  Vector values(system_.size());
  SPREKK_ASSERT(scales_.size() == fields_.size(), scales_.size(), fields_.size());
  for (std::size_t u = 0; u < fields_.size(); ++u)
    values.segment(system_.first(static_cast<int>(u)), fields_[u]->size()) = fields_[u]->now() / scales_[u];
  return values;
}

void IterateStep::set_scaled_values(const Vector& values) {
  SPREKK_EXPECT(values.size() == system_.size(), values.size(), system_.size());
  for (std::size_t u = 0; u < fields_.size(); ++u)
    fields_[u]->set(values.segment(system_.first(static_cast<int>(u)), fields_[u]->size()) * scales_[u]);
}

Vector IterateStep::accelerated_values() const {
  Eigen::Index size = 0, next = 0;
  for (const std::size_t u : accelerated_) size += fields_[u]->size();
  Vector values(size);
  for (const std::size_t u : accelerated_) {
    values.segment(next, fields_[u]->size()) = fields_[u]->now();
    next += fields_[u]->size();
  }
  return values;
}

void IterateStep::begin_acceleration() {
  acceleration_scale_.resize(accelerated_values().size());
  Eigen::Index next = 0;
  for (const std::size_t u : accelerated_) {
    acceleration_scale_.segment(next, fields_[u]->size()).setConstant(scales_[u]);
    next += fields_[u]->size();
  }
  accelerator_->begin(acceleration_scale_);
}

void IterateStep::accelerate(const Vector& before) {
  const Vector x = before.cwiseQuotient(acceleration_scale_);
  const Vector image = accelerated_values().cwiseQuotient(acceleration_scale_);
  Vector step = accelerator_->next(x, image) - x;
  if (const double longest = options_.acceleration.largest_step * (image - x).norm(); longest > 0)
    step *= std::min(1.0, longest / std::max(longest, step.norm()));
  const Vector values = (x + step).cwiseProduct(acceleration_scale_);
  Eigen::Index next = 0;
  for (const std::size_t u : accelerated_) {
    fields_[u]->set(values.segment(next, fields_[u]->size()));
    next += fields_[u]->size();
  }
}

void IterateStep::choose_scales() {
  // Fields of one unit share a scale, as in Newton's test: a jump that is still round-off must not count.
  std::map<std::string, double> largest;
  for (const Field* field : fields_) {
    double& l = largest[field->spec().unit];
    if (field->size() > 0)
      l = std::max({l, field->now().lpNorm<Eigen::Infinity>(), field->accepted().lpNorm<Eigen::Infinity>()});
  }
  constexpr double digits = 1e-8;  // a field with fewer must not hide the changes of others
  for (std::size_t u = 0; u < fields_.size(); ++u) {
    double l = largest[fields_[u]->spec().unit];
    if (!round_off_.empty() && fields_[u]->size() > 0) l = std::max(l, round_off_[u].maxCoeff() / digits);
    scales_[u] = (l > 0 ? l : 1) * std::sqrt(std::max(1, fields_[u]->size()));
  }
}

void IterateStep::find_round_off(const StepTime& step) {
  Assembly assembly(inside_->unknowns(), Assembly::Request::residual_and_derivatives);
  assemble_all(assembly, parts_, step);
  const Vector all = round_off_of_values(assembly, system_);
  round_off_.clear();
  for (std::size_t u = 0; u < fields_.size(); ++u)
    round_off_.emplace_back(all.segment(system_.first(static_cast<int>(u)), fields_[u]->size()));
}

double IterateStep::largest_change(std::size_t field, const Vector& change) const {
  if (change.size() == 0) return 0;
  if (round_off_.empty() || !is_finite(change)) return change.lpNorm<Eigen::Infinity>();
  return std::max(0.0, (change.cwiseAbs() - round_off_[field]).maxCoeff());
}

double IterateStep::relative_change(const Vector& change, const Vector& before) const {
  const auto part = [&](const Vector& of, std::size_t u) {
    const auto values = of.segment(system_.first(static_cast<int>(u)), fields_[u]->size());
    return values.size() > 0 ? scales_[u] * values.lpNorm<Eigen::Infinity>() : 0.0;
  };
  std::map<std::string, double> largest;
  for (std::size_t u = 0; u < fields_.size(); ++u) {
    double& l = largest[fields_[u]->spec().unit];
    l = std::max({l, part(before, u), part(before + change, u)});
  }
  double relative = 0;
  for (std::size_t u = 0; u < fields_.size(); ++u) {
    const double l = largest[fields_[u]->spec().unit];
    const auto changed = change.segment(system_.first(static_cast<int>(u)), fields_[u]->size());
    if (l > 0) relative = std::max(relative, largest_change(u, scales_[u] * changed) / l);
  }
  return relative;
}

std::string IterateStep::remedies() const {
  std::string text = "solve them in one 'solve'";
  if (!inside_->is_stabilized()) {
    text += accelerator_ ? ", or" : ",";
    text += " give one of them 'stabilize: response'";
    std::set<std::string> offered;
    for (const auto* part : parts_with<Stabilizes>(parts_))
      for (const std::string& name : part->stabilizations()) offered.insert(name);
    for (const std::string& name : offered) text += " or '" + name + "'";
  }
  if (!accelerator_) text += ", or accelerate with 'anderson'";
  return text;
}

StepStatus IterateStep::without_end(const StepTime& step, const std::string& what, double factor, int pass) {
  StepStatus status{false, what + " (the steps inside act on one another too strongly) " + remedies(), pass};
  status.is_hopeless = diverging_.is_no_better(step, factor);
  if (!status.is_hopeless) return status;
  status.reason += "; shorter steps do no better";
  constexpr double clearly_less = 0.5;  // a factor that is bounded by other equations says little
  if (factor < clearly_less * diverging_.largest())
    status.reason += fmt::format(", and in longer ones each pass changed {:.3g} times as much as the one before",
                                 diverging_.largest());
  return status;
}

ResidualCheck IterateStep::check_changes(const std::vector<Vector>& before) const {
  std::map<std::string, double> largest;
  for (const Field* field : fields_)
    if (field->size() > 0) {
      double& l = largest[field->spec().unit];
      l = std::max({l, field->now().lpNorm<Eigen::Infinity>(), field->accepted().lpNorm<Eigen::Infinity>()});
    }
  ResidualCheck check;
  for (std::size_t u = 0; u < fields_.size(); ++u) {
    if (fields_[u]->size() == 0) continue;
    const double scale = largest[fields_[u]->spec().unit];
    const double change = largest_change(u, fields_[u]->now() - before[u]);
    check.finite = check.finite && fields_[u]->now().allFinite();
    const double relative = scale > 0 ? change / scale : 0;
    check.of_equations.emplace_back(fields_[u]->name(), relative);
    if (relative < check.largest && !check.equation.empty()) continue;
    check.largest = relative;
    check.equation = fields_[u]->name();
  }
  return check;
}

namespace {

constexpr std::size_t without_progress = 25;                     // passes
constexpr std::size_t patience = 10, patience_accelerated = 20;  // passes whose changes stay large

/// "pore" of "pore.pressure".
std::string owner_of(const std::string& field) { return field.substr(0, field.find('.')); }

}  // namespace

StepStatus IterateStep::converged(const StepTime& step, const StepStatus& status) {
  // Each substep has added its exchange to the cumulative balances already.
  if (options_.has_substeps || !status.converged) return status;
  for (Part* part : parts_) part->after_solve(fields_, step);
  std::vector<CountsLater*> counting;
  for (Part* part : parts_)
    if (auto* later = dynamic_cast<CountsLater*>(part)) counting.push_back(later);
  if (counting.empty()) return status;
  Assembly assembly(inside_->unknowns(), Assembly::Request::residual);
  assemble_all(assembly, parts_, step);
  for (CountsLater* later : counting) later->count_rest_later(assembly);
  return status;
}

double IterateStep::largest_imbalance() const {
  if (options_.has_substeps || !options_.until.bounds_residual()) return std::numeric_limits<double>::infinity();
  return looser_for_balances * options_.until.loosest();
}

ResidualCheck IterateStep::coupled_residual(const StepTime& step) const {
  Assembly assembly(inside_->unknowns(), Assembly::Request::residual);
  assemble_all(assembly, parts_, step);
  return check_residual(assembly, system_, options_.until.tightest());
}

StepStatus IterateStep::run(const StepTime& step) {
  std::vector<Vector> start;
  for (const Field* field : fields_) start.push_back(field->now());
  if (fallback_) fallback_->begin(step);
  StepStatus status = make_passes(step);
  if (!status.converged && accelerator_ && accelerator_->forget_steps()) {
    for (std::size_t u = 0; u < fields_.size(); ++u) fields_[u]->set(start[u]);
    begin_step(parts_, step);
    const int before = status.iterations;
    status = make_passes(step);
    status.iterations += before;
  }
  if (status.converged || !fallback_) return status;
  if (accelerator_) accelerator_->rewound();
  return converged(step, fallback_->solve(step, status));
}

void IterateStep::add_counts(LinearCounts& counts) const {
  inside_->add_counts(counts);
  if (fallback_) fallback_->add_counts(counts);
}

void IterateStep::note_step(Notes& notes, const StepTime& step) const {
  inside_->note_step(notes, step);
  if (fallback_) fallback_->note_step(notes, step);
}

StepStatus IterateStep::make_passes(const StepTime& step) {
  scales_.assign(fields_.size(), 1);
  ResidualCheck check;
  PassChanges changes;
  StalledAcceleration stalled;
  bool is_plain = false;
  Vector unaccelerated;  // the values at the start of the plain passes
  std::uint64_t last_state = 0;
  std::multiset<std::uint64_t> seen_states;
  bool is_cycling = false;
  int of_newton = 0;
  double change_before = 0;
  Vector last_change;
  std::vector<double> residuals;   // after each pass but the first
  std::vector<double> imbalances;  // after the last passes, while they leave balances alone
  for (int pass = 1; pass <= options_.until.at_most; ++pass) {
    *pass_ = pass;
    const Vector before = pass > 1 ? scaled_values() : Vector();
    const Vector accelerated = accelerator_ ? accelerated_values() : Vector();
    std::vector<Vector> values_before;
    if (criteria_.need_changes() || options_.has_substeps)
      for (const Field* field : fields_) values_before.push_back(field->now());
    // Where all rows hold and balances do not, each solve may disturb the balances of the others by round-off, which no
    // pass makes smaller. The pass then ends after the solve that fulfils the balances.
    const bool misses_balances_alone = check.rows_hold && !check.balances_hold;
    const StepStatus inner = misses_balances_alone
                                 ? inside_->run_until(step, [&] { return coupled_residual(step).converged; })
                                 : inside_->run(step);
    if (!inner.converged) {
      StepStatus failed{false, fmt::format("pass {}: {}", pass, inner.reason), pass};
      if (!inner.lost_at) return failed;
      const std::optional<double> size = losses_.size_to_repeat(step, *inner.lost_at);
      failed.is_hopeless = !size;
      failed.retry_dt = size.value_or(0);
      return failed;
    }
    of_newton = std::max(of_newton, inner.effort());
    std::uint64_t state = 0;
    for (const auto* part : parts_with<PiecewiseSmooth>(parts_)) state = state * 1000003 + part->discrete_state();

    Assembly assembly(inside_->unknowns(), Assembly::Request::residual);
    if (!options_.has_substeps) assemble_all(assembly, parts_, step);
    if (options_.has_substeps && pass == 1) find_round_off(step);
    change_before = check.largest;
    check = options_.has_substeps ? check_changes(values_before)
                                  : check_residual(assembly, system_, options_.until.tightest());
    const Vector change = pass > 1 ? Vector(scaled_values() - before) : Vector();
    if (log_) log_({step, "iterate", pass, check.largest, check.equation, change.norm(), 1, check.of_equations});
    if (!check.finite)
      return {false, (options_.has_substeps ? "" : "the residual of ") + check.equation + " is not finite", pass};
    const auto residual_holds = [&](double bound) {
      if (options_.has_substeps) return pass > 2 && is_error_below(bound, check.largest, change_before);
      return bound == options_.until.tightest() ? check.converged : check_residual(assembly, system_, bound).converged;
    };
    if (criteria_.hold(pass, residual_holds, check.of_equations, values_before))
      return converged(step, {true, "", pass, 0, of_newton});
    if (pass == 1) {
      choose_scales();
      if (!accelerator_) continue;
      begin_acceleration();
      last_state = state;
      accelerate(accelerated);
      continue;
    }
    changes.add(change.norm(), relative_change(change, before));
    last_change = change;
    // If passes change no more than round-off, the imbalance that is left is round-off of the fields.
    if (check.rows_hold && changes.are_round_off()) return converged(step, {true, "", pass, 0, of_newton});
    if (!check.rows_hold || check.balances_hold) imbalances.clear();
    if (check.rows_hold && !check.balances_hold) imbalances.push_back(check.imbalance);
    if (are_round_off_of_balances(imbalances)) return converged(step, {true, "", pass, 0, of_newton});
    residuals.push_back(check.largest);
    if (changes.are_round_off() && !options_.has_substeps && hardly_fall(residuals, without_progress))
      return {
          false,
          fmt::format("the iteration stagnates after {} passes: the residual of {} stays at {:.2g} of its terms, and "
                      "passes change {} most, by round-off, {:.3g} times as much as the one before (the fields have "
                      "no more digits in this split) solve '{}' with what it is coupled to in one 'solve'{}",
                      pass, check.equation, check.largest, most_changed(change), changes.factor(),
                      owner_of(check.equation), looser_tolerance(check.largest)),
          pass};
    if (const bool explode = !accelerator_ && changes.explode(); explode || changes.only_grow()) {
      const double factor = explode ? changes.last_factor() : changes.factor();
      return without_end(step,
                         fmt::format("the iteration diverges: each pass changes {} {:.3g} times as much as the one "
                                     "before",
                                     most_changed(change), factor),
                         factor, pass);
    }
    if (changes.stay_large(accelerator_ ? patience_accelerated : patience))
      return without_end(step,
                         fmt::format("the iteration does not converge: after {} passes each one still changes {} by "
                                     "{:.2g} of its largest value, {:.3g} times as much as the one before",
                                     pass, most_changed(change), changes.last_relative(), changes.factor()),
                         changes.factor(), pass);
    // Passes may cycle between discrete states, like Newton's method. Then a pass that changes the state is halved, and
    // passes are not accelerated.
    if (state != last_state) {
      is_cycling = is_cycling || seen_states.count(state) > 1;
      seen_states.insert(state);
    }
    if (is_cycling && state != last_state) {
      constexpr double half = 0.5;
      last_state = state;
      set_scaled_values(before + half * change);
      continue;
    }
    const bool is_other_state = state != last_state;
    last_state = state;
    if (!accelerator_ || is_cycling) continue;
    // The accelerator may use earlier passes only as long as all of them belong to one smooth map.
    if (is_other_state) {
      accelerator_->forget();
      stalled.forget();
      is_plain = false;
    }
    const StalledAcceleration::Next next = stalled.after(change.norm());
    const bool was_plain = std::exchange(is_plain, next == StalledAcceleration::Next::plain);
    if (next == StalledAcceleration::Next::accelerated) {
      accelerate(accelerated);
      continue;
    }
    accelerator_->forget();
    if (!was_plain || !is_plain) changes.begin_again();
    if (next == StalledAcceleration::Next::back)
      set_scaled_values(unaccelerated);
    else if (!was_plain)
      unaccelerated = scaled_values();
  }
  std::string reason = fmt::format("no convergence in {} passes: {} of {} is {:.2g} of its {}", options_.until.at_most,
                                   options_.has_substeps ? "the last change" : "the residual", check.equation,
                                   check.largest, options_.has_substeps ? "largest value" : "terms");
  if (last_change.size() > 0 && changes.have_a_factor())
    reason += fmt::format(", and a pass changes {} most, {:.3g} times as much as the one before",
                          most_changed(last_change), changes.factor());
  return {false, reason, options_.until.at_most};
}

}  // namespace sprekk
