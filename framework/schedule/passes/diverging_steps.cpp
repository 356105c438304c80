#include "framework/schedule/passes/diverging_steps.hpp"

#include <algorithm>

#include "framework/assert.hpp"

namespace sprekk {

bool DivergingSteps::is_no_better(const StepTime& step, double factor) {
  constexpr double much_shorter = 0.3, better = 0.9;  // two cuts by half
  const bool is_same = longest_ && longest_->step.start == step.start && step.dt < longest_->step.dt;
  const double largest = is_same ? std::max(longest_->largest, factor) : factor;
  if (is_same && factor > better * longest_->factor) return step.dt < much_shorter * longest_->step.dt;
  longest_ = {step, factor, largest};
  return false;
}

double DivergingSteps::largest() const {
  SPREKK_EXPECT(longest_.has_value());
  return longest_->largest;
}

}  // namespace sprekk
