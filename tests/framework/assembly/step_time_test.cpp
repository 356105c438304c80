#include "framework/assembly/step_time.hpp"

#include <gtest/gtest.h>

namespace sprekk {
namespace {

/// 2 in [6, 21), 0 elsewhere.
Data window() {
  return Data([](const Place& place) { return place.t >= 6 && place.t < 21 ? 2.0 : 0.0; }, true, false, {6, 21});
}

double value(const Data& data, double start, double end) { return value_in_step(data, {}, {start, end - start, end}); }

TEST(ValueInStep, IsThatOfTheEndWhereNothingJumps) {
  const Data ramp([](const Place& place) { return 3 * place.t; }, true, false);
  EXPECT_EQ(value(ramp, 1, 2), 6);
  EXPECT_EQ(value(window(), 9, 10), 2);
  EXPECT_EQ(value(window(), 1, 2), 0);
}

TEST(ValueInStep, IsTheOneThatHeldUntilAJumpAtTheEnd) {
  EXPECT_EQ(value(window(), 5, 6), 0);
  EXPECT_EQ(value(window(), 6, 7), 2);
  EXPECT_EQ(value(window(), 20, 21), 2);
  EXPECT_EQ(value(window(), 21, 22), 0);
}

TEST(ValueInStep, IsTheOneThatHoldsFromThenOnWithoutALength) {
  EXPECT_EQ(value(window(), 5, 5), 0);
  EXPECT_EQ(value(window(), 6, 6), 2);
  EXPECT_EQ(value(window(), 21, 21), 0);
}

TEST(ValueInStep, OverlooksRoundOffBetweenTheEndAndTheJump) {
  EXPECT_EQ(value(window(), 20, 21 * (1 + 1e-15)), 2);
  EXPECT_EQ(value(window(), 20, 21 * (1 - 1e-15)), 2);
  EXPECT_EQ(value(window(), 5, 6 * (1 + 1e-15)), 0);
}

TEST(ValueInStep, FollowsWhatChangesInsideAWindowUntilItsEnd) {
  const Data data([](const Place& place) { return place.t < 21 ? place.t : 0.0; }, true, false, {21});
  EXPECT_NEAR(value(data, 20, 21), 21, 1e-14);
}

TEST(ValueInStep, TreatsEachComponentOfAVectorByItself) {
  const VectorData vector{{window(), Data(5)}};
  EXPECT_EQ(value_in_step(vector, Place{}, {20, 1, 21}), Point(2, 5));
}

}  // namespace
}  // namespace sprekk
