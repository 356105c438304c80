// The end of equilibria in a solve of an iteration, while the unknowns of its other solves are held.
#pragma once

#include <optional>

#include "framework/assembly/step_time.hpp"

namespace sprekk {

/// Decides what follows when a solve in a pass finds that equilibria end at some time of the step. Other unknowns are
/// held meanwhile; over a shorter step they change less, and the time of the end may become later. So a step to shortly
/// before this time is tried. If an end is found again, and the run has advanced by more than the end has moved, no
/// step is short enough: the run ends with that reason.
class LossesInPasses {
 public:
  /// `at`: when equilibria end in the step, s. The size with which it is to be repeated, s; none where that is
  /// hopeless.
  std::optional<double> size_to_repeat(const StepTime& step, double at);

 private:
  struct Loss {
    double start, at;  ///< s
  };
  std::optional<Loss> last_;
};

}  // namespace sprekk
