// Parts that bound the length of time steps.
#pragma once

#include <string>

namespace sprekk {

/// Capability: bounds the next step, for what is explicit in time, or accurate over short steps only. Where the bound
/// is what a step must keep to as a result of itself, refuse the step instead (StepStatus::retry_dt).
class LimitsStep {
 public:
  virtual ~LimitsStep() = default;
  /// s, positive; infinity where nothing bounds the step that begins at `start` (s) from the accepted state. The same
  /// on a repetition of the step; each process may know its own part, the shortest counts. A step that would be longer
  /// is divided into equal ones; a bound below the smallest step of the scene ends the run.
  virtual double longest_step(double start) const = 0;
};

}  // namespace sprekk
