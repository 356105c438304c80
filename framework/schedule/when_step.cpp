#include "framework/schedule/when_step.hpp"

#include "framework/invariants.hpp"

namespace sprekk {

Spec WhenOptions::spec() {
  Spec spec("when", "Runs the steps inside only while a condition holds.");
  spec.data("when", condition,
            {.doc = "An expression of t (s), evaluated at the middle of the time step; it holds when it is not 0.",
             .required = true,
             .in_time = true});
  return spec;
}

bool WhenStep::holds(const StepTime& step) const {
  SPREKK_EXPECT(step.end > step.start, step.start, step.end);
  return options_.condition.at({Point::Zero(), 0, 0.5 * (step.start + step.end)}) != 0;
}

StepStatus WhenStep::run(const StepTime& step) { return holds(step) ? inside_->run(step) : StepStatus{true, "", 0}; }

}  // namespace sprekk
