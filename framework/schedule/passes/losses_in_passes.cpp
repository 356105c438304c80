#include "framework/schedule/passes/losses_in_passes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/invariants.hpp"

namespace sprekk {

std::optional<double> LossesInPasses::size_to_repeat(const StepTime& step, double at) {
  SPREKK_EXPECT(std::isfinite(at), at);
  constexpr double most_of_the_way = 0.9;  // the end is known as well as loads are linear in the step
  // If the distance to the end falls by less than half of each advance, it falls by a factor in each step, and no step
  // reaches the end.
  const bool is_again = last_ && step.start == last_->start;
  const bool stays_ahead = last_ && step.start > last_->start && at - last_->at < 0.5 * (step.start - last_->start);
  last_ = {step.start, at};
  if (stays_ahead) return std::nullopt;
  const double left = std::max(at - step.start, std::numeric_limits<double>::min());  // a size below 0 asks for none
  // Where loads are not linear in the step, a shorter step has found an earlier end.
  return (is_again ? 0.5 : most_of_the_way) * left;
}

}  // namespace sprekk
