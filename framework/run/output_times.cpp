#include "framework/run/output_times.hpp"

#include <algorithm>
#include <cmath>

#include "framework/round_off.hpp"

namespace sprekk {

OutputTimes::OutputTimes(const Scene& scene)
    : times_(scene.output.times), tolerance_(rounding::same * scene.time.step) {
  if (scene.output.every)
    for (long i = 1; scene.time.start + i * *scene.output.every < scene.time.end * (1 + rounding::of_terms); ++i)
      times_.push_back(scene.time.start + i * *scene.output.every);
  times_.push_back(scene.time.end);
}

bool OutputTimes::contains(double time) const {
  return std::any_of(times_.begin(), times_.end(), [&](double other) { return std::abs(other - time) <= tolerance_; });
}

}  // namespace sprekk
