// grow: lets fractures grow after the steps before it, and settles the state on the mesh that has grown with them.
#pragma once

#include <algorithm>
#include <optional>

#include "framework/schedule/growing.hpp"
#include "framework/schedule/solve_step.hpp"

namespace sprekk {

inline constexpr const char *automatic = "auto", *within_step = "within_step", *after_step = "after_step",
                            *repeat_step = "repeat_step";

/// Parameters of a `grow` step.
struct GrowOptions {
  std::string component;
  std::vector<std::string> settle;
  std::string update = automatic;
  bool is_followed = false;  ///< whether another step of the schedule solves or grows behind it
  int passes = 20;           ///< of repeat_step
  double cut = 1e-2;         ///< size of the steps after a growth event, over the standard step
  double settled = 1e-2;     ///< relative change over a step at and below which the standard step returns
  /// Relative excess of the load of growth above which a step is repeated shorter; without one GrowStep has its own.
  std::optional<double> overshoot;
  Origin origin;
  NewtonOptions newton;
  LinearOptions linear;
  Spec spec();
};

/// Asks the component for the load of its tips, and lets them grow. So that growth starts at its load, a step after
/// which the load of a tip that has not grown yet is above 1 + overshoot is refused, with a step size after which the
/// load is expected to be 1 + overshoot/2. A step in which tips grow further than the mesh can follow is refused, too.
/// No step is cut below `cut` of the standard step. extensions() has the paths that the mesh is to take over; the run
/// changes the mesh between two attempts.
class GrowStep : public ScheduleStep {
 public:
  /// Throws InputError when the component has nothing that grows or no loads of its tips, and when `settle` lacks a
  /// component that another one needs (Part::dependences).
  GrowStep(const GrowOptions& options, const ScheduleContext& context);
  StepStatus run(const StepTime& step) override;
  std::vector<const Field*> unknowns() const override { return {}; }
  int systems_in_turn(const StepTime&) const override { return 0; }
  std::string describe() const override { return "grow " + options_.component; }
  void add_counts(LinearCounts& counts) const override { settle_.add_counts(counts); }

  const GrowOptions& options() const { return options_; }
  double overshoot() const { return *options_.overshoot; }
  /// By how much the load of tips that grow already may pass 1.
  double loads_of_growing() const;
  bool grows_within_step() const { return options_.update == within_step; }
  /// In which steps tips grow with the state held, as with after_step, although growth belongs to the steps.
  enum class Holding {
    never,
    if_far_above,  ///< in a step that may not shrink, if tips are far above the load of growth
    always
  };
  void choose(Holding holding) { holding_ = holding; }
  bool is_held() const { return is_held_; }  ///< in the last attempt
  /// For trials of a search for growth within the step: run() only examines the tips that are searched for. All other
  /// tips grow once the right trial has been found.
  void examine_followed_only(bool only) { followed_only_ = only; }
  /// While it `rests`, run() does nothing and keeps the results of the last attempt.
  void rest(bool rests) { rests_ = rests; }
  /// Whether the step was run in an attempt at this time step: a `when` may leave it out.
  bool was_run(const StepTime& step) const { return last_ && last_->start == step.start && last_->dt == step.dt; }
  Growing& component() const { return *growing_; }
  bool may_shrink(const StepTime& step) const;  ///< whether the step is longer than the smallest one
  bool repeats_step() const { return options_.update == repeat_step; }
  const std::vector<PathExtension>& extensions() const { return extensions_; }
  CavityOptions cavity() const { return growing_->cavity(); }
  /// Whether the state at the tips still changes after a growth event.
  bool is_unsettled() const { return load_.unsettled > options_.settled; }
  /// Whether growth in the last attempt has ended and settled: no tip that grew was above the load of growth by more
  /// than the overshoot, and the state at the tips has not changed, or changes at a constant rate. Tips that are
  /// closed, or would grow by less than the shortest increment, do not count, since they may stay above this load while
  /// others grow.
  bool has_come_to_rest() const {
    return extensions_.empty() && growth_load_ <= 1 + loads_of_growing() && load_.uneven <= options_.settled;
  }
  /// The largest load of all tips over 1 + overshoot/2, the load at which a repetition of a refused step is to end.
  double nearness() const { return std::max(load_.now, load_.onset) / (1 + 0.5 * overshoot()); }
  /// Solves for the components of `settle` at fixed values of everything else, with data as in the given step.
  StepStatus settle(const StepTime& step) { return settle_.run(step); }

 private:
  /// Throws UnsolvedGrowth.
  StepStatus look_and_grow(const StepTime& step);
  /// Refuses a step, and asks for one at whose end the load is 1 + overshoot/2. `before`, `now`: the loads at its start
  /// and at its end.
  StepStatus refused(const std::string& reason, const StepTime& step, double before, double now, double overshoot);
  /// The load of the tips, and whether they grow with the state held.
  Growing::Load examine(const StepTime& step);
  Growing* growing_;
  GrowOptions options_;
  SolveStep settle_;
  double smallest_step_;  ///< s; no step is refused below it
  Growing::Load load_;
  /// A step that was refused because its load came too far above 1.
  struct Refusal {
    double start, dt, before, load;  ///< s, s, loads of the tip for which the step was refused at its start and end
  };
  std::optional<Refusal> refusal_;  ///< the last one
  std::optional<StepTime> last_;    ///< the time step of the last run
  std::vector<PathExtension> extensions_;
  Holding holding_ = Holding::never;
  double growth_load_ = 0;  ///< Growing::Growth::load of the last attempt
  bool is_held_ = false, rests_ = false, followed_only_ = false;
};

}  // namespace sprekk
