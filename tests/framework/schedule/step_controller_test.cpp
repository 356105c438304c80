#include "framework/schedule/step_controller.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <utility>
#include <vector>

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

using State = std::map<std::string, Vector>;

State state_of(const StepController& controller) {
  State state;
  controller.save(state);
  return state;
}

StepController continued(const State& state, StepController fresh) {
  fresh.restore(state);
  return fresh;
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

// A step of an hour fails whenever it is tried: it is tried after 3 shorter ones, then after 6, 12, …
TEST(StepController, WaitsLongerEachTimeBeforeItTriesWhatFailed) {
  StepController controller(hours(100), {});
  std::vector<int> accepted_between;
  for (int tries = 0, accepted = 0; tries < 4;) {
    const StepTime step = controller.next();
    if (step.dt < 1) {
      controller.accepted(step, 1);
      ++accepted;
      continue;
    }
    accepted_between.push_back(accepted);
    accepted = 0;
    ++tries;
    EXPECT_TRUE(controller.rejected(step));
  }
  EXPECT_EQ(accepted_between, (std::vector<int>{0, 3, 6, 12}));
}

TEST(StepController, ForgetsAFailureWhenTheSizeSucceeds) {
  StepController controller(hours(100), {});
  EXPECT_TRUE(controller.rejected(controller.next()));
  for (int i = 0; i < 4; ++i) controller.accepted(controller.next(), 1);
  EXPECT_EQ(controller.next().dt, 1);
  EXPECT_EQ(controller.failed().size, 0);
}

TEST(StepController, ContinuesWhereItWas) {
  StepController whole(hours(3), {1.5});
  whole.accepted(whole.next(), 1);
  const StepController part = continued(state_of(whole), {hours(3), {1.5}});
  EXPECT_EQ(ends(part), ends(whole));
}

TEST(StepController, RepeatsAStepWithTheSizeThatIsAskedFor) {
  TimeOptions options = hours(10);
  options.smallest = 0.1;
  StepController controller(options, {});
  EXPECT_TRUE(controller.rejected(controller.next(), 0.3));
  EXPECT_EQ(controller.next().dt, 0.3);
  // Never larger than what was refused, never below the smallest.
  EXPECT_TRUE(controller.rejected(controller.next(), 5));
  EXPECT_EQ(controller.next().dt, 0.3);
  EXPECT_TRUE(controller.rejected(controller.next(), 1e-9));
  EXPECT_EQ(controller.next().dt, 0.1);
  EXPECT_FALSE(controller.rejected(controller.next(), 0.05));
  // Without an opinion: `shrink`.
  StepController other(options, {});
  EXPECT_TRUE(other.rejected(other.next(), 0));
  EXPECT_EQ(other.next().dt, options.shrink);
}

TEST(StepController, GrowsBackAfterARetry) {
  StepController controller(hours(10), {});
  EXPECT_TRUE(controller.rejected(controller.next(), 0.5));
  std::vector<double> sizes;
  for (int i = 0; i < 4; ++i) {
    sizes.push_back(controller.next().dt);
    controller.accepted(controller.next(), 1);
  }
  EXPECT_EQ(sizes, (std::vector<double>{0.5, 0.75, 1, 1}));
}

TEST(StepController, HoldsASizeUntilItIsReleased) {
  for (const bool adaptive : {false, true}) {
    TimeOptions options = hours(10);
    options.adaptive = adaptive;
    options.largest = 4;
    StepController controller(options, {0.7});
    controller.hold(0.25, 1);
    std::vector<double> ends;
    for (int i = 0; i < 3; ++i) {
      const StepTime step = controller.next();
      ends.push_back(step.end);
      controller.accepted(step, 1);
    }
    // Targets are met all the same; an adaptive run halves the last two steps before one.
    EXPECT_NEAR(ends[0], 0.25, 1e-15);
    EXPECT_NEAR(ends[1], adaptive ? 0.475 : 0.5, 1e-15);
    EXPECT_EQ(ends[2], 0.7);
    EXPECT_EQ(controller.held(), 0.25);
    EXPECT_EQ(controller.wanted(), 0.25);
    controller.release(0);
    EXPECT_EQ(controller.held(), 0);
    EXPECT_EQ(controller.next().dt, 1);
  }
}

// After a release it takes as long as it did the last time, but not less than a tenth of a step.
TEST(StepController, AReleasedStepIsAsLongAsTheLastPause) {
  StepController controller(hours(10), {});
  controller.hold(0.01, 1);
  controller.release(0);
  EXPECT_EQ(controller.next().dt, 1);  // nothing is known yet
  EXPECT_TRUE(controller.rejected(controller.next(), 0.4));
  controller.accepted(controller.next(), 1);
  controller.hold(0.01, 1);
  controller.accepted(controller.next(), 1);
  controller.hold(0.01, 1);  // goes on: no new pause
  controller.accepted(controller.next(), 1);
  controller.release(0);
  EXPECT_NEAR(controller.next().dt, 0.4, 1e-15);
  EXPECT_TRUE(controller.rejected(controller.next(), 0.02));
  controller.accepted(controller.next(), 1);
  controller.hold(0.01, 1);
  controller.release(0);
  EXPECT_NEAR(controller.next().dt, 0.1, 1e-15);
  // A pause that is longer than a step is no limit; until the hold comes, steps grow as after any cut.
  for (int i = 0; i < 9; ++i) controller.accepted(controller.next(), 1);
  EXPECT_EQ(controller.next().dt, 1);
  controller.hold(0.01, 1);
  controller.release(0);
  EXPECT_EQ(controller.next().dt, 1);
}

// A level that rises at a constant rate, 0.5 an hour, and falls with each hold.
TEST(StepController, AHoldIsExpectedWhereTheLevelComesToOne) {
  StepController controller(hours(20), {5});
  controller.hold(0.01, 1);
  controller.release(0.8);
  EXPECT_TRUE(controller.rejected(controller.next(), 0.4));
  controller.accepted(controller.next(), 1);
  controller.hold(0.01, 1);  // 0.4 h for a rise of 0.2
  controller.release(0.6);
  EXPECT_NEAR(controller.next().dt, 0.8, 1e-12);
  controller.accepted(controller.next(), 1);
  EXPECT_NEAR(controller.time(), 1.2, 1e-12);
  controller.hold(0.01, 1.5);  // beyond 1 it gives no rate
  controller.release(0.3);
  EXPECT_EQ(controller.next().dt, 1);
  controller.accepted(controller.next(), 1);
  EXPECT_NEAR(controller.next().dt, 0.4, 1e-12);  // of 1.4 h
  controller.accepted(controller.next(), 1);
  controller.hold(0.01, 1);
  controller.release(0);
  for (int i = 0; i < 2; ++i) controller.accepted(controller.next(), 1);
  EXPECT_NEAR(controller.time(), 4.6, 1e-12);
  controller.hold(0.01, 1);
  controller.release(0.5);
  controller.accepted(controller.next(), 1);
  EXPECT_EQ(controller.time(), 5);  // a target is met on the way
  EXPECT_NEAR(controller.next().dt, 0.6, 1e-12);
}

// A level is known to about 1 %, the tolerance of an arrest: a smaller rise in the last pause gives no rate, and the
// pause is repeated. With a larger one the level, twice as far below 1, takes twice the time.
TEST(StepController, ARiseWithinTheToleranceOfLevelsTellsNoRate) {
  for (const auto& [rise, expected] : {std::pair{0.009, 0.4}, {0.011, 0.8}}) {
    StepController controller(hours(20), {});
    controller.hold(0.01, 1);
    controller.release(1 - rise);
    EXPECT_TRUE(controller.rejected(controller.next(), 0.4));
    controller.accepted(controller.next(), 1);
    controller.hold(0.01, 1);  // 0.4 h for this rise
    controller.release(1 - 2 * rise);
    EXPECT_NEAR(controller.next().dt, expected, 1e-12) << rise;
  }
  // The same of what has risen since: 0.004 in 0.4 h counts as 0.01, so that 0.036 more take 1.44 h.
  StepController controller(hours(20), {});
  controller.hold(0.01, 1);
  controller.release(0.96);
  EXPECT_TRUE(controller.rejected(controller.next(), 0.4));
  controller.accepted(controller.next(), 1);
  controller.hold(0.01, 1);
  controller.release(0.96);
  EXPECT_NEAR(controller.next().dt, 0.4, 1e-12);
  controller.accepted(controller.next(), 1);
  controller.observe(0.964);
  EXPECT_NEAR(controller.next().dt, 1, 1e-12);
  controller.accepted(controller.next(), 1);
  EXPECT_NEAR(controller.next().dt, 0.44, 1e-12);
}

TEST(StepController, AnOverdueHoldIsExpectedFromTheRiseSoFar) {
  StepController controller(hours(20), {});
  controller.hold(0.01, 1);
  controller.release(0.5);
  EXPECT_TRUE(controller.rejected(controller.next(), 0.6));
  controller.accepted(controller.next(), 1);
  controller.hold(0.01, 1);
  controller.release(0.5);
  controller.accepted(controller.next(), 1);
  controller.observe(0.8);  // 0.3 in 0.6 h, and 0.2 are left
  EXPECT_NEAR(controller.next().dt, 0.4, 1e-12);
  controller.accepted(controller.next(), 1);
  controller.observe(1.2);  // it has come to 1 and nothing was held: nothing is expected
  EXPECT_EQ(controller.next().dt, 1);
}

TEST(StepController, ALevelThatRestsBelowOneCostsFewSteps) {
  StepController controller(hours(1000), {});
  controller.hold(0.01, 1);
  controller.release(0.5);
  EXPECT_TRUE(controller.rejected(controller.next(), 0.6));
  controller.accepted(controller.next(), 1);
  controller.hold(0.01, 1);
  controller.release(0.5);
  while (!controller.is_finished()) {
    controller.accepted(controller.next(), 1);
    controller.observe(0.9999);
  }
  EXPECT_LE(controller.steps(), 1000 + 16);  // 0.1, 0.2, 0.4, … h, and what is left of each wait beyond whole steps
}

// Expectations end steps, but sizes go on as if they did not.
TEST(StepController, AnExpectationLeavesTheSizeAsItIs) {
  TimeOptions options = hours(20);
  options.adaptive = true;
  options.largest = 4;
  options.iterations = 8;
  StepController controller(options, {});
  controller.hold(0.01, 1);
  controller.release(0.5);
  EXPECT_TRUE(controller.rejected(controller.next(), 0.2));
  controller.accepted(controller.next(), 5);
  controller.hold(0.01, 1);
  controller.release(0.5);
  EXPECT_NEAR(controller.next().dt, 0.2, 1e-12);
  controller.accepted(controller.next(), 5);  // neither many iterations nor few
  EXPECT_EQ(controller.next().dt, 1);
}

TEST(StepController, HoldsAreExpectedBeforeTimeZeroToo) {
  TimeOptions options = hours(3);
  options.start = -2.5;
  StepController controller(options, {});
  EXPECT_EQ(ends(controller), (std::vector<double>{-1.5, -0.5, 0.5, 1.5, 2.5, 3}));
  controller.hold(0.01, 1);
  controller.release(0.5);
  EXPECT_TRUE(controller.rejected(controller.next(), 0.2));
  controller.accepted(controller.next(), 1);
  controller.hold(0.01, 1);
  controller.release(0.5);
  EXPECT_NEAR(controller.next().dt, 0.2, 1e-12);
}

TEST(StepController, AnExpectationIsMetBeforeTheWayToATargetIsHalved) {
  TimeOptions options = hours(20);
  options.adaptive = true;
  StepController controller(options, {1.5});
  controller.hold(0.01, 1);
  controller.release(0);
  controller.accepted(controller.next(), 5);  // half of the way to the target
  controller.hold(0.01, 1);
  controller.release(0.25);
  EXPECT_NEAR(controller.next().dt, 0.75 * 0.75, 1e-12);
}

// Steps that something else limits are equal parts of what is left to a target, and a limit that does not bind changes
// nothing.
TEST(StepController, ALimitLeavesNoTinyStepBeforeATarget) {
  StepController controller(hours(10), {3});
  EXPECT_EQ(controller.next(0.9).end, 0.75);
  EXPECT_EQ(controller.next(1).end, 1);
  EXPECT_EQ(controller.next(5).end, 1);
  EXPECT_EQ(controller.next(std::numeric_limits<double>::infinity()).end, 1);
  std::vector<double> sizes;
  while (controller.time() < 3) {
    const StepTime step = controller.next(0.8);
    EXPECT_DOUBLE_EQ(step.end, step.start + step.dt);
    sizes.push_back(step.dt);
    controller.accepted(step, 1);
  }
  ASSERT_EQ(sizes.size(), 4u);
  for (const double size : sizes) EXPECT_NEAR(size, 0.75, 1e-15);
  EXPECT_EQ(controller.time(), 3);  // the exact value
  EXPECT_NEAR(controller.next(0.6).dt, 7 / 12.0, 1e-15);
}

// A step that is as short as the smallest could not be cut.
TEST(StepController, ALimitIsTakenWholeWhereEqualPartsAreTheSmallestSteps) {
  TimeOptions options = hours(10);
  options.smallest = 0.5;
  const StepController controller(options, {1});
  EXPECT_EQ(controller.next(0.9).dt, 0.9);
  options.smallest = 0.4;
  EXPECT_EQ(StepController(options, {1}).next(0.9).dt, 0.5);
}

TEST(StepController, ContinuesWithTheLastPause) {
  StepController whole(hours(10), {});
  whole.hold(0.01, 1);
  whole.release(0);
  EXPECT_TRUE(whole.rejected(whole.next(), 0.4));
  whole.accepted(whole.next(), 1);
  whole.hold(0.01, 1);
  StepController part = continued(state_of(whole), {hours(10), {}});
  part.release(0);
  EXPECT_NEAR(part.next().dt, 0.4, 1e-15);
}

TEST(StepController, ContinuesWithWhatItExpects) {
  StepController whole(hours(20), {});
  whole.hold(0.01, 1);
  whole.release(0.4);
  EXPECT_TRUE(whole.rejected(whole.next(), 0.7));
  whole.accepted(whole.next(), 1);
  whole.hold(0.01, 1);
  whole.release(0.6);
  for (int i = 0; i < 6; ++i) {
    StepController part = continued(state_of(whole), {hours(20), {}});
    EXPECT_EQ(part.next().end, whole.next().end) << i;
    whole.accepted(whole.next(), 1);
    whole.observe(0.99);
    part.accepted(part.next(), 1);
    part.observe(0.99);
    EXPECT_EQ(part.next().end, whole.next().end) << i;
  }
}

TEST(StepController, ReleasingWhatIsNotHeldChangesNothing) {
  StepController controller(hours(10), {});
  EXPECT_TRUE(controller.rejected(controller.next(), 0.5));
  controller.release(0);
  EXPECT_EQ(controller.next().dt, 0.5);
}

TEST(StepController, ARetryWhileHeldGrowsBackToWhatIsHeld) {
  StepController controller(hours(10), {});
  controller.hold(0.4, 1);
  EXPECT_TRUE(controller.rejected(controller.next(), 0.2));
  std::vector<double> sizes;
  for (int i = 0; i < 4; ++i) {
    sizes.push_back(controller.next().dt);
    controller.accepted(controller.next(), 1);
  }
  EXPECT_EQ(sizes[0], 0.2);
  EXPECT_NEAR(sizes[1], 0.3, 1e-15);
  EXPECT_EQ(sizes[2], 0.4);
  EXPECT_EQ(sizes[3], 0.4);
}

TEST(StepController, ContinuesWhatWasHeld) {
  StepController whole(hours(3), {});
  whole.hold(0.25, 1);
  whole.accepted(whole.next(), 1);
  StepController part = continued(state_of(whole), {hours(3), {}});
  EXPECT_EQ(part.held(), 0.25);
  EXPECT_EQ(ends(part), ends(whole));
  part.release(0);
  EXPECT_EQ(part.next().dt, 1);
}

}  // namespace
}  // namespace sprekk
