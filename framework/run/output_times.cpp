#include "framework/run/output_times.hpp"

#include <algorithm>
#include <cmath>

namespace sprekk {

OutputTimes::OutputTimes(const Scene& scene) : times_(scene.output.times), tolerance_(1e-9 * scene.time.step) {
  if (scene.output.every)
    for (long i = 1; scene.time.start + i * *scene.output.every < scene.time.end * (1 + 1e-12); ++i)
      times_.push_back(scene.time.start + i * *scene.output.every);
  times_.push_back(scene.time.end);
}

bool OutputTimes::contains(double time) const {
  return std::any_of(times_.begin(), times_.end(), [&](double other) { return std::abs(other - time) <= tolerance_; });
}

}  // namespace sprekk
