// What follows when equilibria end in a solve of an iteration: the run comes nearer, or ends.
#include "framework/schedule/passes/losses_in_passes.hpp"

#include <gtest/gtest.h>

namespace sprekk {
namespace {

StepTime from_to(double start, double end) { return {start, end - start, end}; }

StepStatus judged(LossesInPasses& losses, const StepTime& step, double at) {
  StepStatus status;
  losses.judge(step, at, status);
  return status;
}

TEST(LossesInPasses, AnEndThatStaysEndsTheRunAfterOneApproach) {
  LossesInPasses losses;
  const StepStatus first = judged(losses, from_to(5, 6), 5.3);
  EXPECT_FALSE(first.is_hopeless);
  EXPECT_NEAR(first.retry_dt, 0.27, 1e-12);
  const StepStatus second = judged(losses, from_to(5.27, 5.7), 5.3);
  EXPECT_TRUE(second.is_hopeless);
  EXPECT_EQ(second.retry_dt, 0);
}

/// Reference: an end that moves away by the part r of what the run comes nearer is reached in infinitely many steps, at
/// 5 + 0.3/(1 − r) s, for r < 1, and never for r >= 1.
TEST(LossesInPasses, AnEndThatMovesAwayAsFastIsFollowed) {
  for (const double recedes : {0.0, 0.4, 0.6, 1.0, 2.0}) {
    LossesInPasses losses;
    double start = 5, at = 5.3;
    int approaches = 0;
    while (approaches < 10) {
      const StepStatus status = judged(losses, from_to(start, start + 1), at);
      if (status.is_hopeless) break;
      ++approaches;
      at += recedes * status.retry_dt;
      start += status.retry_dt;
    }
    EXPECT_EQ(approaches, recedes < 0.5 ? 1 : 10) << recedes;
  }
}

/// A shorter step from the same start that finds an earlier end is shortened by more, and an end at the start itself
/// asks for the shortest step.
TEST(LossesInPasses, StepsFromOneStartBecomeShorter) {
  LossesInPasses losses;
  EXPECT_NEAR(judged(losses, from_to(0, 1), 0.5).retry_dt, 0.45, 1e-12);
  const StepStatus again = judged(losses, from_to(0, 0.45), 0.4);
  EXPECT_FALSE(again.is_hopeless);
  EXPECT_NEAR(again.retry_dt, 0.2, 1e-12);
  const StepStatus at_start = judged(losses, from_to(0, 0.2), 0);
  EXPECT_FALSE(at_start.is_hopeless);
  EXPECT_GT(at_start.retry_dt, 0);
  EXPECT_LT(at_start.retry_dt, 1e-300);
}

}  // namespace
}  // namespace sprekk
