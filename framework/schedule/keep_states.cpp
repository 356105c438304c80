// After a solution in which cells have left their discrete states by a jump: looks for the solution to which small
// increments from the start of the step lead.
#include "framework/schedule/newton.hpp"

namespace sprekk {

int Newton::keep_states(const StepTime& step, const std::vector<Vector>& start) {
  int kept = 0, iterations = 0;
  for (Part* part : parts_) kept += part->keep_states();
  if (kept == 0) return 0;
  const std::vector<Vector> found = values();
  set(start);
  while (true) {
    const StepStatus tried = attempt(step, options_.undamped, Until::search);
    iterations += tried.iterations;
    int released = 0;
    if (tried.converged)
      for (Part* part : parts_) released += part->release_violated();
    if (tried.converged && released == 0) break;
    kept -= released;
    if (tried.converged && kept > 0) continue;
    set(found);
    iterations = 0;
    break;
  }
  for (Part* part : parts_) part->release_kept();
  return iterations;
}

}  // namespace sprekk
