// The conditions that end a run before its end time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/run/steady_state.hpp"
#include "framework/run/stop_condition.hpp"

namespace sprekk {

/// The conditions `stop:` and `stop_when_steady:` of `time:`.
class EarlyEnd {
 public:
  /// `quantities`: of the scene. Throws InputError as StopCondition does.
  EarlyEnd(const Scene& scene, const std::vector<Quantity>& quantities) : stop_(scene, quantities) {}

  /// Checks a step that is about to be accepted, with the quantities at its end.
  void check(const Model& model, const StepTime& step, const std::vector<Quantity>& quantities);

  bool is_reached() const { return steady_since_ || has_stopped_; }
  std::string text() const;                          ///< "fluid_injected has reached 3 m^2", "steady since 3 h"
  bool has_stopped() const { return has_stopped_; }  ///< by `stop:`
  /// Says what `stop:` was reached with before the first step: "slip.t is 0 m at the start", else "".
  std::string reached_at_start() const { return stop_.was_reached_at_start() ? stop_.start_text() : ""; }
  const std::optional<double>& steady_since() const { return steady_since_; }  ///< s
  /// Says that `stop:` has not been reached: "fluid_injected is 2 m^2, and has not reached 3 m^2".
  std::string missed_text(const std::vector<Quantity>& quantities) const { return stop_.missed_text(quantities); }

 private:
  StopCondition stop_;
  std::optional<double> steady_since_;
  bool has_stopped_ = false;
  std::string stop_text_;
};

}  // namespace sprekk
