#include "framework/run/step_attempts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

#include "framework/config/state.hpp"
#include "framework/outside/outside_error.hpp"
#include "framework/parallel/interruption.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"
#include "framework/schedule/limits_step.hpp"

namespace sprekk {

StepAttempts::Outcome StepAttempts::run() {
  if (const std::string why = limit_steps(); !why.empty()) return give_up(why);
  for (bool has_grown = false;;) {
    step_ = next_step();
    progress_.phase(fmt::format("step {} from {} over {}", state_.controller.steps() + 1, duration_text(step_.start),
                                duration_text(step_.dt)));
    // On a mesh that has grown within the step the attempt must come to its end: a checkpoint does not contain the
    // change.
    if (const auto given_up = try_once(!has_grown)) return *given_up;
    effort_.attempted(status_);
    if (!status_.converged) {
      if (!cut()) return Outcome::failed;
      continue;
    }
    const MeshGrowth::Outcome growth = follow_growth();
    if (growth == MeshGrowth::Outcome::nothing) return Outcome::converged;
    if (growth == MeshGrowth::Outcome::failed) return Outcome::failed;
    has_grown = true;
  }
}

std::optional<StepAttempts::Outcome> StepAttempts::try_once(bool may_be_interrupted) {
  try {
    const ScopedTimer timer(profile_, "steps");
    std::optional<interruption::Allowed> allowed;
    if (may_be_interrupted) allowed.emplace();
    status_ = growth_.attempt(step_);
    return std::nullopt;
  } catch (const StateError& error) {
    status_ = {.converged = false, .reason = error.what()};
    return std::nullopt;
  } catch (const DataError& error) {
    return give_up(name() + " has no data: " + error.what());
  } catch (const OutsideError& error) {
    return give_up(name() + " cannot be taken: " + error.what());
  } catch (const Interrupted&) {
    give_up("interrupted");
    return Outcome::interrupted;
  } catch (const std::bad_alloc&) {
    if (parallel::size() > 1) throw;
    return give_up(name() + " needs more memory than there is");
  }
}

StepAttempts::Outcome StepAttempts::give_up(const std::string& why) {
  state_.model->rewind();
  reason_ = why;
  return Outcome::failed;
}

MeshGrowth::Outcome StepAttempts::follow_growth() {
  const ScopedTimer timer(profile_, "change of mesh");
  const MeshGrowth::Outcome outcome = growth_.before_acceptance();
  if (outcome == MeshGrowth::Outcome::failed) reason_ = growth_.reason();
  return outcome;
}

std::string StepAttempts::limit_steps() {
  longest_ = std::numeric_limits<double>::infinity();
  const double start = state_.controller.time();
  const auto limit = [&](const auto& parts) -> std::string {
    for (const auto& part : parts) {
      const auto* limiting = dynamic_cast<const LimitsStep*>(part.get());
      if (!limiting) continue;
      const double longest = -parallel::max(-limiting->longest_step(start));
      if (!(longest >= state_.controller.smallest()))
        return fmt::format("{} allows steps of {:.3g} s at most from {} on, less than the smallest ({})", part->name(),
                           longest, duration_text(start), duration_text(state_.controller.smallest()));
      longest_ = std::min(longest_, longest);
    }
    return {};
  };
  const std::string why = limit(state_.model->components());
  return why.empty() ? limit(state_.model->couplers()) : why;
}

/// The step that is due, unless a part or growth at the speed of the last one needs a shorter one.
StepTime StepAttempts::next_step() const {
  StepTime step = state_.controller.next(growth_.longest_step());
  // Equal parts, so that no tiny step is left: round-off of sums of steps.
  if (const double parts = std::ceil(step.dt / longest_ - rounding::same); parts > 1) {
    step.dt /= parts;
    step.end = step.start + step.dt;
  }
  return step;
}

/// False when the step is as small as allowed, or a smaller one is known to fail.
bool StepAttempts::cut() {
  state_.model->rewind();
  effort_.rejected();
  // A step that asks for another size has not failed.
  const bool has_failed = status_.retry_dt <= 0;
  reason_ = fmt::format("{} {}: {}", name(), has_failed ? "did not converge" : "is too long", status_.reason);
  if (status_.is_hopeless) return false;
  if (!state_.controller.rejected(step_, status_.retry_dt)) {
    reason_ += " (the step is as small as allowed)";
    return false;
  }
  const std::string next = duration_text(next_step().dt);
  if (has_failed) note_cut();
  progress_.event(has_failed ? fmt::format("step cut: {}; again over {}", reason_, next)
                             : fmt::format("step from {} shortened from {} to {}: {}", duration_text(step_.start),
                                           duration_text(step_.dt), next, status_.reason));
  return true;
}

void StepAttempts::note_cut() {
  const std::string topic = "steps cut";
  Notes& notes = state_.notes;
  const auto known = std::ranges::find(notes.all(), topic, &Notes::Note::topic);
  const double count = known == notes.all().end() ? 1 : known->measure + 1;
  notes.at_time(step_.start);
  notes.add(
      topic,
      fmt::format("{} {} converge, and shorter steps were taken in their place (the last time since {}) where that "
                  "costs much, take shorter steps from the start, or another scheme",
                  count, count == 1 ? "attempt at a step did not" : "attempts at steps did not", reason_),
      count);
}

std::string StepAttempts::name() const {
  return fmt::format("the step from {} over {}", duration_text(step_.start), duration_text(step_.dt));
}

}  // namespace sprekk
