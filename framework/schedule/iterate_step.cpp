#include "framework/schedule/iterate_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "framework/assembly/assemble_all.hpp"
#include "framework/assembly/counts_later.hpp"
#include "framework/assembly/stabilizes.hpp"
#include "framework/invariants.hpp"
#include "framework/outside/solved_outside.hpp"
#include "framework/round_off.hpp"
#include "framework/schedule/passes/ends_of_passes.hpp"
#include "framework/schedule/passes/round_off_of_values.hpp"

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
  // What another program solves for is in no system with other unknowns.
  const bool is_all_known =
      std::ranges::none_of(fields_, [&](const Field* field) { return is_solved_outside(*field, context.parts); });
  if (options_.fallback == "monolithic" && !options_.has_substeps && is_all_known)
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
  for (std::size_t u = 0; u < fields_.size(); ++u) {
    double l = largest[fields_[u]->spec().unit];
    if (!round_off_.empty() && fields_[u]->size() > 0)
      l = std::max(l, round_off_[u].maxCoeff() / rounding::half_of_digits);
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

}  // namespace sprekk
