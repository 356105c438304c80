#include "framework/mesh/ways_to_middle.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace sprekk {
namespace {

/// An arm of the resistivity r, whose walls are as tight as it is along itself.
CrossingArm arm(int fracture, double length, double width, double r) {
  return {fracture, length, width, r, 0.5 * width * r};
}

double resistance(const CrossingArm& arm, const WayToMiddle& way) {
  return way.kept * arm.resistivity * arm.length / arm.width + way.added;
}

TEST(WaysToMiddle, PassTheHarmonicMeanOfTwoFractures) {
  // Widths of 0.2 and 0.1: within the crossing 0.05 and 0.1 of half cells of 1 and 2.
  const std::vector<CrossingArm> arms = {arm(0, 1, 0.2, 3), arm(0, 1, 0.2, 3), arm(1, 2, 0.1, 7), arm(1, 2, 0.1, 7)};
  const std::vector<WayToMiddle> ways = ways_to_middle(arms, {});
  for (const int i : {0, 1}) EXPECT_NEAR(resistance(arms[i], ways[i]), (0.95 * 3 + 0.05 * 5) / 0.2, 1e-13);
  for (const int i : {2, 3}) EXPECT_NEAR(resistance(arms[i], ways[i]), (1.9 * 7 + 0.1 * 5) / 0.1, 1e-12);
}

TEST(WaysToMiddle, CountEachFractureOnce) {
  // A T, and three fractures of which one begins there: the mean of the resistivities 3, 7 (and 11).
  std::vector<CrossingArm> arms = {arm(0, 1, 0.2, 3), arm(0, 1, 0.2, 3), arm(1, 2, 0.1, 7)};
  EXPECT_NEAR(resistance(arms[0], ways_to_middle(arms, {})[0]), (0.95 * 3 + 0.05 * 5) / 0.2, 1e-13);
  arms.push_back(arm(2, 1, 0.4, 11));
  const std::vector<WayToMiddle> ways = ways_to_middle(arms, {});
  EXPECT_NEAR(resistance(arms[0], ways[0]), (0.8 * 3 + 0.2 * 7) / 0.2, 1e-13);
  EXPECT_NEAR(resistance(arms[2], ways[2]), (1.8 * 7 + 0.2 * 7) / 0.1, 1e-12);
  EXPECT_NEAR(resistance(arms[3], ways[3]), (0.9 * 11 + 0.1 * 7) / 0.4, 1e-12);
}

TEST(WaysToMiddle, AreThoseOfHalfCellsWhereFracturesAreAlike) {
  const std::vector<CrossingArm> cross = {arm(0, 1, 0.2, 0.3), arm(0, 1, 0.2, 0.3), arm(1, 2, 0.1, 0.3)};
  // End to end: halves in series, also of unlike fractures.
  const std::vector<CrossingArm> series = {arm(0, 1, 0.2, 3), arm(1, 2, 0.1, 7)};
  for (const std::vector<CrossingArm>& arms : {cross, series})
    for (const WayToMiddle& way : ways_to_middle(arms, {})) {
      EXPECT_EQ(way.kept, 1);
      EXPECT_EQ(way.added, 0);
    }
  // Nearly alike: nearly the same.
  std::vector<CrossingArm> nearly = cross;
  nearly[2].resistivity *= 1 + 1e-9;
  const std::vector<WayToMiddle> ways = ways_to_middle(nearly, {});
  for (std::size_t i = 0; i < nearly.size(); ++i)
    EXPECT_NEAR(resistance(nearly[i], ways[i]) / resistance(nearly[i], {}), 1, 1e-9);
}

TEST(WaysToMiddle, PassAGivenFill) {
  const std::vector<CrossingArm> arms = {arm(0, 1, 0.2, 3), arm(0, 1, 0.2, 3), arm(1, 2, 0.1, 3)};
  const std::vector<WayToMiddle> ways = ways_to_middle(arms, {none, 100.0});
  EXPECT_NEAR(resistance(arms[0], ways[0]), (0.95 * 3 + 0.05 * 100) / 0.2, 1e-12);
  EXPECT_NEAR(resistance(arms[2], ways[2]), (1.9 * 3 + 0.1 * 100) / 0.1, 1e-12);
}

TEST(WaysToMiddle, PassTheWallsOfAFractureThatGoesThrough) {
  std::vector<CrossingArm> arms = {arm(0, 1, 0.2, 3), arm(0, 1, 0.2, 3), arm(1, 2, 0.1, 7), arm(1, 2, 0.1, 7)};
  arms[0].across = arms[1].across = 40;
  const std::vector<WayToMiddle> ways = ways_to_middle(arms, {0, {}});
  for (const int i : {0, 1}) EXPECT_EQ(resistance(arms[i], ways[i]), 3 / 0.2);
  for (const int i : {2, 3}) EXPECT_NEAR(resistance(arms[i], ways[i]), 1.9 * 7 / 0.1 + 40 / 0.1, 1e-12);
}

TEST(WaysToMiddle, PassTheWallsOfAFractureWithoutWidth) {
  std::vector<CrossingArm> arms = {arm(0, 1, 0, 3), arm(0, 1, 0, 3), arm(1, 2, 0.1, 7)};
  arms[0].across = arms[1].across = 40;
  EXPECT_NEAR(resistance(arms[2], ways_to_middle(arms, {0, {}})[2]), 2 * 7 / 0.1 + 40 / 0.1, 1e-12);
}

TEST(WaysToMiddle, AreSealedByASealedFractureAndLeaveOutArmsWithoutWidth) {
  const double sealed = std::numeric_limits<double>::infinity();
  std::vector<CrossingArm> arms = {arm(0, 1, 0.2, 3), arm(0, 1, 0.2, 3), arm(1, 2, 0.1, sealed),
                                   arm(1, 2, 0.1, sealed)};
  EXPECT_EQ(ways_to_middle(arms, {})[0].added, sealed);
  // One arm that conducts keeps the crossing open: the mean of its conductivities.
  arms[3].resistivity = 3.5;
  EXPECT_NEAR(resistance(arms[0], ways_to_middle(arms, {})[0]), (0.95 * 3 + 0.05 * 5) / 0.2, 1e-13);
  arms[2].width = arms[3].width = 0;
  EXPECT_EQ(ways_to_middle(arms, {})[0].added, 0);
}

TEST(WaysToMiddle, KeepNothingOfAHalfCellWithinTheCrossing) {
  const std::vector<CrossingArm> arms = {arm(0, 0.1, 0.2, 3), arm(0, 0.1, 0.2, 3), arm(1, 2, 0.5, 7)};
  EXPECT_NEAR(resistance(arms[0], ways_to_middle(arms, {})[0]), 0.1 * 5 / 0.2, 1e-13);
}

}  // namespace
}  // namespace sprekk
