// How a step of the schedule ended.
#pragma once

#include <string>

namespace sprekk {

/// Nobody infers convergence from a count: a step says whether it converged, and why not.
struct StepStatus {
  bool converged = false;
  std::string reason;  ///< why not
  int iterations = 0;  ///< the most that any solve or iteration inside has needed
};

}  // namespace sprekk
