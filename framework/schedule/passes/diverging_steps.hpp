// Whether shorter time steps help an iteration whose passes diverge.
#pragma once

#include <optional>

#include "framework/assembly/step_time.hpp"

namespace sprekk {

/// Remembers by which factor changes grew from pass to pass in the steps that were tried from one start.
class DivergingSteps {
 public:
  /// To be called when the passes of `step` diverge; `factor`: by which changes grow from pass to pass. Returns whether
  /// shortening does not help: whether another step from the same start was much longer, but diverged hardly faster.
  bool is_no_better(const StepTime& step, double factor);
  /// The largest factor of any step from the start of the last one. To be called after is_no_better.
  double largest() const;

 private:
  struct Divergence {
    StepTime step;
    double factor;
    double largest;
  };
  std::optional<Divergence> longest_;  ///< the longest step from its start that diverged hardly faster
};

}  // namespace sprekk
