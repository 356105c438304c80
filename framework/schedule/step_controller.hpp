// Who decides the next time step.
#pragma once

#include <string>
#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/config/spec.hpp"

namespace sprekk {

struct TimeOptions {
  double start = 0;                ///< s
  double end = 0;                  ///< s
  double step = 0;                 ///< s, the first and, unless adaptive, the standard one
  std::optional<double> smallest;  ///< s; a rejected step is not cut below it
  bool adaptive = false;
  double largest = 0;  ///< s, of adaptive steps
  double grow = 1.5, shrink = 0.5;
  int iterations = 8;  ///< adaptive steps grow while no solve needs more than half of these, and shrink beyond them
  Spec spec();
};

/// Constant or adaptive steps that end exactly at the targets (output times, switches of sources, the end). A rejected
/// step is repeated with a smaller one; afterwards steps grow back by `grow` a step.
class StepController {
 public:
  /// `targets`: times (s) that a step must end at, in any order; those outside of the run are ignored.
  StepController(const TimeOptions& options, std::vector<double> targets);

  bool is_finished() const { return time_ >= options_.end; }
  double time() const { return time_; }
  int steps() const { return steps_; }
  double wanted() const { return wanted_; }  ///< s, the size of the next step unless it is cut to hit a target
  StepTime next() const;

  void accepted(const StepTime& step, int iterations);
  /// Cuts the step; false when it is as small as allowed.
  bool rejected(const StepTime& step);

  /// Continues from a checkpoint.
  void restore(double time, int steps, double wanted);

 private:
  TimeOptions options_;
  std::vector<double> targets_;
  double time_, wanted_;
  int steps_ = 0;
};

}  // namespace sprekk
