// How a step of the schedule ended.
#pragma once

#include <optional>
#include <string>

namespace sprekk {

/// Whether a step converged, and if not, why. Callers must not infer convergence from the number of iterations.
struct StepStatus {
  bool converged = false;
  std::string reason;   ///< why not
  int iterations = 0;   ///< the most that any solve or iteration inside has needed
  double retry_dt = 0;  ///< s; the size with which to repeat a step that did not converge, 0 where the caller chooses
  /// The largest number of Newton iterations in a solve inside, where `iterations` counts passes; negative where
  /// `iterations` are Newton's.
  int of_newton = -1;

  /// s; the time from which on there is no equilibrium while unknowns of other solves are held, if that is why not.
  std::optional<double> lost_at = std::nullopt;
  bool is_hopeless = false;  ///< shorter steps from the same start are known to fail as well

  /// The measure for adaptive steps. Passes are none: where systems are split, shorter steps need as many, or more.
  int effort() const { return of_newton >= 0 ? of_newton : iterations; }
};

}  // namespace sprekk
