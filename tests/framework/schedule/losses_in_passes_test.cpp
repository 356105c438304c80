// What follows when equilibria end in a solve of an iteration: the run comes nearer, or ends.
#include "framework/schedule/passes/losses_in_passes.hpp"

#include <gtest/gtest.h>

namespace sprekk {
namespace {

StepTime from_to(double start, double end) { return {start, end - start, end}; }

TEST(LossesInPasses, AnEndThatStaysEndsTheRunAfterOneApproach) {
  LossesInPasses losses;
  EXPECT_NEAR(losses.size_to_repeat(from_to(5, 6), 5.3).value(), 0.27, 1e-12);
  EXPECT_FALSE(losses.size_to_repeat(from_to(5.27, 5.7), 5.3).has_value());
}

/// Reference: an end that moves away by the part r of what the run comes nearer is reached in infinitely many steps, at
/// 5 + 0.3/(1 − r) s, for r < 1, and never for r >= 1.
TEST(LossesInPasses, AnEndThatMovesAwayAsFastIsFollowed) {
  for (const double recedes : {0.0, 0.4, 0.6, 1.0, 2.0}) {
    LossesInPasses losses;
    double start = 5, at = 5.3;
    int approaches = 0;
    while (approaches < 10) {
      const std::optional<double> size = losses.size_to_repeat(from_to(start, start + 1), at);
      if (!size) break;
      ++approaches;
      at += recedes * *size;
      start += *size;
    }
    EXPECT_EQ(approaches, recedes < 0.5 ? 1 : 10) << recedes;
  }
}

/// A shorter step from the same start that finds an earlier end is shortened by more, and an end at the start itself
/// asks for the shortest step.
TEST(LossesInPasses, StepsFromOneStartBecomeShorter) {
  LossesInPasses losses;
  EXPECT_NEAR(losses.size_to_repeat(from_to(0, 1), 0.5).value(), 0.45, 1e-12);
  EXPECT_NEAR(losses.size_to_repeat(from_to(0, 0.45), 0.4).value(), 0.2, 1e-12);
  const double at_start = losses.size_to_repeat(from_to(0, 0.2), 0).value();
  EXPECT_GT(at_start, 0);
  EXPECT_LT(at_start, 1e-300);
}

}  // namespace
}  // namespace sprekk
