#include "framework/run/output_times.hpp"

#include <algorithm>
#include <cmath>

namespace sprekk {

namespace {
constexpr double rounding = 1e-9;         ///< of the standard step: times nearer than this are the same
constexpr double before_the_end = 1e-12;  ///< of the end: multiples of an interval that are the end to rounding
}  // namespace

OutputTimes::OutputTimes(const Scene& scene) : times_(scene.output.times), tolerance_(rounding * scene.time.step) {
  if (scene.output.every)
    for (long i = 1; scene.time.start + i * *scene.output.every < scene.time.end * (1 + before_the_end); ++i)
      times_.push_back(scene.time.start + i * *scene.output.every);
  times_.push_back(scene.time.end);
}

bool OutputTimes::contains(double time) const {
  return std::any_of(times_.begin(), times_.end(), [&](double other) { return std::abs(other - time) <= tolerance_; });
}

}  // namespace sprekk
