// Releases held coefficients in small shares, from the end of a path of Newton's method.
#include <fmt/format.h>

#include <algorithm>

#include "framework/invariants.hpp"
#include "framework/schedule/newton.hpp"

namespace sprekk {

StepStatus Newton::attempt_with_share(const StepTime& step, double share) {
  SPREKK_EXPECT(share > 0 && share <= 1, share);
  for (PiecewiseSmooth* part : pieces_) part->release_coefficients(share);
  return attempt(step, options_.undamped);
}

/// Coefficients c_0^(1 - share) c^share, for shares that grow from 0, where the path has ended, to 1. Each solution is
/// the start for the next share. After a failure the increment of the share is halved, after a success doubled.
StepStatus Newton::release_coefficients(const StepTime& step, const std::vector<Vector>& start) {
  constexpr double first = 0.25, smallest = 1.0 / 64;
  std::vector<Vector> reached = values();
  set(start);
  for (PiecewiseSmooth* part : pieces_) part->hold_coefficients();
  set(reached);
  int iterations = 0;
  double share = 0, increment = first;
  std::string reason;
  while (share < 1 && increment >= smallest) {
    const double next = std::min(1.0, share + increment);
    const StepStatus status = attempt_with_share(step, next);
    iterations += status.iterations;
    if (status.converged) {
      share = next;
      increment *= 2;
      if (share < 1) reached = values();
    } else {
      reason = status.reason;
      increment = 0.5 * (next - share);
      set(reached);
    }
  }
  for (PiecewiseSmooth* part : pieces_) part->release_coefficients(1);
  if (share == 1) return {true, "", iterations};
  return {
      false,
      fmt::format("the coefficients could be released from their values at the start up to a share of {:.2g} only: {}",
                  share, reason),
      iterations};
}

}  // namespace sprekk
