// The load of each tip in the state that a step has found.
#include <algorithm>
#include <cmath>

#include "components/fine_fracture/tips/ends.hpp"
#include "components/fine_fracture/tips/tips.hpp"

namespace sprekk::fine_fracture {

void Tips::note_start(const StepTime& step) {
  if (examined_ == step.start) return;
  examined_ = step.start;
  for (Tip& tip : tips_) tip.length_at_start = tip.accepted.grown + length_of(position(tip, {}), tip.accepted.path);
  for (Joint& joint : joints_) joint.length_at_start = joint.grown;
}

double Tips::rest_tolerance() const { return options_.growth.seeks_arrest() ? options_.growth.arrest_tolerance : 0; }

/// The load above which the tip grows is 1. At the end of an increment K_eq is the toughness within a tolerance, and
/// the tip must not grow again for that difference. A tip that has not grown yet has no such rest: refused steps aim at
/// the load 1 + overshoot/2, where it has to grow.
double Tips::growth_load(const Tip& tip) const {
  return tip.now.load / (1 + (tip.now.has_started ? rest_tolerance() : 0));
}

Growing::Load Tips::examine(const StepTime& step, bool followed_only) {
  note_start(step);
  surroundings_->update();
  notes_.clear();
  constexpr double safety = 2;  // the estimate may be too small by this factor
  const bool may_rule_out = options_.toughness && options_.skip_below > 0;
  Load loads;
  const std::vector<TipPath> paths = paths_now();
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    Tip& tip = tips_[i];
    if (is_held_) tip.now.speed = tip.now.turning = 0;
    if (tip.now.is_stopped) {
      tip.now.is_evaluated = false;
      continue;
    }
    const double now = surroundings_->fluid_pressure(tip.end.fracture, tip.end.at_end);
    const double before = surroundings_->accepted_fluid_pressure(tip.end.fracture, tip.end.at_end);
    tip.now.pressure_rate = (now - before) / step.dt;
    if (now != before) {
      const double change = std::abs(now - before), size = std::max(now, before),
                   uneven = std::abs(now - before - tip.accepted.pressure_rate * step.dt);
      loads.unsettled = std::max(loads.unsettled, change / size);
      loads.uneven = std::max(loads.uneven, std::min(change, uneven) / size);
    }
    if (followed_only && !is_followed(tip)) continue;
    const double estimate = may_rule_out && tip.now.path.added.empty() ? estimated_load(tip) : 0;
    if (tip.evaluated_for == surroundings_->version()) {
      ++kept_;
    } else if (may_rule_out && tip.now.path.added.empty() && safety * estimate < options_.skip_below) {
      ++skipped_;
      tip.now.is_evaluated = false;
      tip.now.load = estimate;
    } else {
      set_factors(tip, evaluate(i, paths));
      tip.evaluated_for = surroundings_->version();
    }
    if (turns_sharply(tip)) tip.now.is_extendable = false;
    if (is_followed(tip)) continue;
    const double rest = tip.now.has_started ? rest_tolerance() : 0;
    loads.now = std::max(loads.now, growth_load(tip));
    loads.accepted = std::max(loads.accepted, tip.accepted.load / (1 + rest));
    if (tip.now.has_started) continue;
    loads.onset = std::max(loads.onset, tip.now.load);
    loads.onset_accepted = std::max(loads.onset_accepted, tip.accepted.load);
  }
  return loads;
}

bool Tips::is_far_above() const {
  constexpr double violent = 1.5;  // K_eq over the toughness: twice the energy that growth takes
  return std::ranges::any_of(tips_, [&](const Tip& tip) {
    if (tip.now.is_stopped || !tip.now.is_evaluated) return false;
    // A load that the fluid has held so far does not end in a jump.
    const double held = is_viscous(tip) ? apparent_toughness(tip, tip.accepted.speed) / toughness(tip) : 1;
    return tip.now.load > violent * std::max(1.0, held);
  });
}

bool Tips::turns_sharply(const Tip& tip) const {
  constexpr double sharp = 0.5;  // rad: a sharper turn begins a new segment
  return tip.now.is_extendable && tip.now.is_evaluated && tip.now.load > 1 && tip.taken_over != examined_ &&
         std::abs(maximum_tangential_angle(felt(tip))) > sharp;
}

}  // namespace sprekk::fine_fracture
