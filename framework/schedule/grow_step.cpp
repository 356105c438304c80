#include "framework/schedule/grow_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"
#include "framework/output/activity.hpp"
#include "framework/round_off.hpp"

namespace sprekk {

Spec GrowOptions::spec() {
  Spec spec("grow",
            "Lets fractures grow (the paper's secs. 3.2, 4.4.2, 4.5). After growth the state is settled on the new "
            "mesh, and small "
            "steps follow until the change at the tips has faded.");
  spec.text("grow", component, {.doc = "The component with growing fractures.", .required = true});
  spec.texts("settle", settle,
             {.doc = "The components whose unknowns are put into equilibrium on the new mesh, everything else held: "
                     "those that determine the deformation.",
              .required = true});
  spec.choice("update", update,
              {{automatic,
                "within_step where it is possible: growth stands last in the schedule, and its length and direction "
                "follow from K_eq = K_IC and K_II = 0 (growth.length: arrest, growth.direction: implicit, no "
                "tolerance); otherwise after_step"},
               {within_step, "the advance of the tips is found together with the state at the end of the step"},
               {after_step, "the step is accepted, and the mesh grows between it and the next"},
               {repeat_step, "the step is repeated on the mesh that has grown, until nothing grows any more"}},
              {.doc = "When the mesh takes over what has grown."});
  spec.integer("passes", passes,
               {.range = between(1, 1000), .doc = "With repeat_step: the most repetitions of one step."});
  spec.quantity("cut", cut,
                {.range = {.low = 0, .high = 1, .low_allowed = false},
                 .doc = "Steps after a growth event are this part of the standard one.",
                 .source = "epsilon of the paper's sec. 4.5"});
  spec.quantity("settled", settled,
                {.range = positive(),
                 .doc = "The standard step returns when the state at the tips, which growth has disturbed, changes by "
                        "less than this share in a step."});
  spec.quantity("overshoot", overshoot,
                {.range = positive(),
                 .doc = "A step is repeated with a smaller one when the load of a tip that has not grown yet passes "
                        "that of growth by more than this part. Without it that is 0.002 with within_step, and 0.02 "
                        "otherwise."});
  return spec;
}

namespace {

constexpr double usual_overshoot = 0.02;  ///< of the load of growth: some steps up to onset, also in diffusion
constexpr double exact_overshoot = 2e-3;  ///< twice the difference of loads between two meshes

/// The suggestion for a `grow` step whose component cannot grow.
std::string growing_in(const ScheduleContext& context) {
  std::string names;
  for (const auto& [name, part] : context.named)
    if (dynamic_cast<const Growing*>(part)) names += (names.empty() ? "'" : ", '") + name + "'";
  return names.empty()
             ? "add a component that can grow ('sprekk list' shows what each type does), or leave the step out"
             : "of the components of this scene these can grow: " + names;
}

Growing* find_growing(const GrowOptions& options, const ScheduleContext& context) {
  const auto found = context.named.find(options.component);
  auto* growing = found == context.named.end() ? nullptr : dynamic_cast<Growing*>(found->second);
  if (!growing && found != context.named.end())
    if (const auto* fixed = dynamic_cast<const NotGrowing*>(found->second))
      throw InputError(options.origin, "component '" + options.component + "' does not grow", fixed->why_no_growth(),
                       "name a component of another type, or leave the step out");
  if (!growing)
    throw InputError(options.origin, "component '" + options.component + "' does not grow",
                     std::string("a 'grow' step needs a component that ") + Growing::promise, growing_in(context));
  growing->require_loads();
  return growing;
}

/// Components that depend on one another must be settled together.
void require_whole(const GrowOptions& options, const ScheduleContext& context) {
  const auto is_settled = [&](const std::string& name) { return std::ranges::count(options.settle, name) > 0; };
  for (const Part* part : context.parts)
    for (const Dependence& dependence : part->dependences())
      if (is_settled(dependence.on) && !is_settled(dependence.component))
        throw InputError(
            options.origin, "'" + dependence.on + "' is settled without '" + dependence.component + "'",
            "what '" + dependence.component + "' asks for would not hold in the state at the start of the next step",
            "name both in 'settle'");
}

SolveOptions settle_options(const GrowOptions& options, const Growing& growing) {
  SolveOptions solve;
  solve.components = options.settle;
  solve.newton = options.newton;
  solve.linear = options.linear;
  if (growing.settling_costs_digits() && solve.linear.type == "auto") solve.linear.type = "mumps";
  return solve;
}

}  // namespace

namespace {

/// Decides what `update: auto` means. A component has one kind of growth in the whole run.
std::string decided_update(const GrowOptions& options, const Growing& growing, const ScheduleContext& context) {
  if (options.update != automatic) return options.update;
  const bool is_held = context.growing && std::ranges::any_of(*context.growing, [&](const GrowStep* other) {
                         return other->options().component == options.component && !other->grows_within_step();
                       });
  return is_held || options.is_followed || !growing.may_grow_within_steps() ? after_step : within_step;
}

GrowOptions decided(GrowOptions options, const Growing& growing, const ScheduleContext& context) {
  options.update = decided_update(options, growing, context);
  if (!options.overshoot) options.overshoot = options.update == within_step ? exact_overshoot : usual_overshoot;
  return options;
}

}  // namespace

GrowStep::GrowStep(const GrowOptions& options, const ScheduleContext& context)
    : growing_(find_growing(options, context)),
      options_(decided(options, *growing_, context)),
      settle_(settle_options(options, *growing_), context),
      smallest_step_(options.cut * context.standard_step) {
  require_whole(options_, context);
  if (grows_within_step()) growing_->grow_within_steps();
}

double GrowStep::loads_of_growing() const { return std::max(overshoot(), usual_overshoot); }

bool GrowStep::may_shrink(const StepTime& step) const { return step.dt > smallest_step_ * (1 + rounding::same); }

StepStatus GrowStep::refused(const std::string& reason, const StepTime& step, double before, double now,
                             double overshoot) {
  SPREKK_EXPECT(std::isfinite(before) && std::isfinite(now), before, now);
  SPREKK_ASSERT(smallest_step_ > 0, smallest_step_);
  constexpr double slowest = 0.4, at_constant_rate = 1;  // powers of time with which loads rise; 1/2: diffusion
  constexpr double least = 0.01, least_by_logarithm = 0.1, most = 0.9;  // of the step that was refused
  // The middle of what is accepted; half of the step where the part to take does not follow from its loads.
  const double wanted = (1 + 0.5 * overshoot - before) / (now - before);  // of the rise of this step
  double part = now > before ? wanted : 0.5;
  if (refusal_ && refusal_->start == step.start && refusal_->before == before && refusal_->dt > step.dt &&
      refusal_->load > now && now > before) {
    const double shortening = std::log(refusal_->dt / step.dt);
    const double power = std::log((refusal_->load - before) / (now - before)) / shortening;
    // Two refusals determine the exponent. Loads that rise more slowly than with the smallest one rise like the
    // logarithm of time, as the pressure at a well, or level off.
    part = power < slowest ? std::max(least_by_logarithm,
                                      std::exp((wanted - 1) * (now - before) * shortening / (refusal_->load - now)))
                           : std::pow(wanted, 1 / std::min(power, at_constant_rate));
  }
  refusal_ = Refusal{step.start, step.dt, before, now};
  StepStatus status{false, reason, 0};
  status.retry_dt = std::max(smallest_step_, step.dt * std::clamp(part, least, most));
  return status;
}

Growing::Load GrowStep::examine(const StepTime& step) {
  is_held_ = grows_within_step() && holding_ == Holding::always;
  growing_->hold(is_held_);
  const Growing::Load load = growing_->examine(step);
  if (!grows_within_step() || holding_ != Holding::if_far_above || may_shrink(step) || !growing_->is_far_above())
    return load;
  is_held_ = true;
  growing_->hold(true);
  return growing_->examine(step);
}

StepStatus GrowStep::run(const StepTime& step) {
  try {
    return look_and_grow(step);
  } catch (const UnsolvedGrowth& unsolved) {
    return {false, unsolved.what(), 0};
  }
}

StepStatus GrowStep::look_and_grow(const StepTime& step) {
  if (rests_) return {true, "", 0};
  last_ = step;
  extensions_.clear();
  growth_load_ = 0;
  now_doing("looking at what may grow");
  if (followed_only_) {
    is_held_ = false;
    growing_->hold(false);
    growing_->examine_followed(step);
    return {true, "", 0};
  }
  load_ = examine(step);
  SPREKK_ASSERT(!std::isnan(load_.now) && !std::isnan(load_.onset), load_.now, load_.onset);
  const double later = loads_of_growing();
  if (load_.onset > 1 + overshoot() && may_shrink(step))
    return refused(fmt::format("a tip is at {:.3g} times the load of growth", load_.onset), step, load_.onset_accepted,
                   load_.onset, overshoot());
  if (load_.now <= 1) return {true, "", 0};
  now_doing("growing");
  Growing::Growth growth = growing_->grow(step);
  // Unstable growth begins as soon as the load is reached, so smaller steps resolve nothing more.
  if (!growth.arrested && load_.now > 1 + later && may_shrink(step))
    return refused("tips grow further than the mesh can follow in one step", step, load_.accepted, load_.now, later);
  extensions_ = std::move(growth.extensions);
  growth_load_ = growth.load;
  return {true, "", 0};
}

}  // namespace sprekk
