#include "framework/assembly/step_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk {

double time_in_step(const Data& data, const StepTime& step) {
  SPREKK_EXPECT(step.dt >= 0, step.start, step.dt, step.end);
  SPREKK_ASSERT(std::is_sorted(data.switch_times().begin(), data.switch_times().end()));
  const std::vector<double>& jumps = data.switch_times();
  // The end of a step and a jump at that time may differ by round-off.
  const double tolerance = rounding::same * step.dt;
  const auto jump = std::lower_bound(jumps.begin(), jumps.end(), step.end - tolerance);
  const bool jumps_at_end = step.dt > 0 && jump != jumps.end() && *jump <= step.end + tolerance;
  return jumps_at_end ? std::nextafter(std::min(*jump, step.end), -std::numeric_limits<double>::infinity()) : step.end;
}

double value_in_step(const Data& data, Place place, const StepTime& step) {
  place.t = time_in_step(data, step);
  return data.at(place);
}

Point value_in_step(const VectorData& data, const Place& place, const StepTime& step) {
  Point value;
  for (int k = 0; k < dimension; ++k) value[k] = value_in_step(data.component[k], place, step);
  return value;
}

}  // namespace sprekk
