// Parts that bound the length of time steps.
#pragma once

#include <optional>
#include <string>

#include "framework/assembly/step_time.hpp"

namespace sprekk {

/// The refusal of a step that has converged: the reason, and the shorter step to try instead.
struct StepTooLong {
  double retry_dt;  ///< s, shorter than the step
  std::string why;
};

/// Capability: bounds the next step, for terms that are explicit in time, or accurate over short steps only. It may
/// also refuse a step that has converged, if the values at its end show that it was too long.
class LimitsStep {
 public:
  virtual ~LimitsStep() = default;
  /// s, positive; infinity if nothing bounds the step that begins at `start` (s) from the accepted state. The same when
  /// the step is repeated. Processes may return different bounds; the shortest counts. A step that would be longer is
  /// divided into equal ones; a bound below the smallest step of the scene ends the run.
  virtual double longest_step(double start) const = 0;
  /// Called when a step has converged, before it is accepted: whether its values show that it was too long. The same on
  /// all processes.
  virtual std::optional<StepTooLong> too_long(const StepTime& /*step*/) const { return std::nullopt; }
};

}  // namespace sprekk
