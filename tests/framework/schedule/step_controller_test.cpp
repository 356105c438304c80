#include "framework/schedule/step_controller.hpp"

#include <gtest/gtest.h>

namespace sprekk {
namespace {

TimeOptions hours(double end) {
  TimeOptions options;
  options.end = end;
  options.step = 1;
  return options;
}

std::vector<double> ends(StepController controller) {
  std::vector<double> ends;
  while (!controller.is_finished() && ends.size() < 100) {
    const StepTime step = controller.next();
    ends.push_back(step.end);
    controller.accepted(step, 1);
  }
  return ends;
}

TEST(StepController, EndsStepsAtTheTargets) {
  EXPECT_EQ(ends(StepController(hours(3), {1.5, 7})), (std::vector<double>{1, 1.5, 2.5, 3}));
}

TEST(StepController, TakesTargetsThatDifferByRoundOffForOne) {
  // An output time and a switch that are both meant to be 1.5; an output time that is meant to be the end.
  const double below = 1.5 * (1 - 1e-15), above = 3 * (1 + 1e-15);
  EXPECT_EQ(ends(StepController(hours(3), {1.5, below, above})), (std::vector<double>{1, below, below + 1, 3}));
  EXPECT_EQ(ends(StepController(hours(3), {3 * (1 - 1e-15)})), (std::vector<double>{1, 2, 3}));
}

TEST(StepController, CutsAStepUntilItIsTooSmall) {
  TimeOptions options = hours(3);
  options.smallest = 0.3;
  StepController controller(options, {});
  EXPECT_TRUE(controller.rejected(controller.next()));
  EXPECT_EQ(controller.next().dt, 0.5);
  EXPECT_TRUE(controller.rejected(controller.next()));
  EXPECT_EQ(controller.next().dt, 0.3);
  EXPECT_FALSE(controller.rejected(controller.next()));
}

TEST(StepController, ContinuesWhereItWas) {
  StepController whole(hours(3), {1.5}), part(hours(3), {1.5});
  whole.accepted(whole.next(), 1);
  part.restore(whole.time(), whole.steps(), whole.wanted());
  EXPECT_EQ(ends(part), ends(whole));
}

}  // namespace
}  // namespace sprekk
