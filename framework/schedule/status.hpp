// How a step of the schedule ended.
#pragma once

#include <string>

namespace sprekk {

/// Nobody infers convergence from a count: a step says whether it converged, and why not.
struct StepStatus {
  bool converged = false;
  std::string reason;   ///< why not
  int iterations = 0;   ///< the most that any solve or iteration inside has needed
  double retry_dt = 0;  ///< s; the size with which to repeat a step that did not converge, 0 for no opinion
};

}  // namespace sprekk
