#include "framework/compare/path_difference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/framework/compare/grids.hpp"

namespace sprekk {
namespace {

using testing::DoubleNear;

std::vector<Position> turned(const std::vector<Position>& points, double angle) {
  std::vector<Position> result;
  for (const auto& [x, y] : points)
    result.push_back({x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle)});
  return result;
}

PathDifference between(const std::vector<Position>& one, const std::vector<Position>& other, double angle) {
  return path_difference(polylines(line(turned(one, angle)), {})[0], polylines(line(turned(other, angle)), {})[0]);
}

TEST(PathDifference, is_the_distance_both_ways_whatever_the_direction) {
  for (const double angle : {0.0, 0.8}) {
    // The second line goes on by 0.5, and is 0.1 aside in its middle.
    const PathDifference found = between({{0, 0}, {1, 0}, {2, 0}}, {{0, 0}, {1, 0.1}, {2, 0}, {2.5, 0}}, angle);
    EXPECT_THAT(found.there, DoubleNear(0.1 * std::cos(std::atan(0.1)), 1e-12));
    EXPECT_THAT(found.back, DoubleNear(0.5, 1e-12));
    EXPECT_THAT(found.sideways, DoubleNear(0.1, 1e-12));
    EXPECT_THAT(found.length, DoubleNear(2 - 2 * std::hypot(1, 0.1) - 0.5, 1e-12));
    EXPECT_THAT(found.scale, DoubleNear(2 * std::hypot(1, 0.1) + 0.5, 1e-12));
    const PathDifference swapped = between({{2.5, 0}, {2, 0}, {1, 0.1}, {0, 0}}, {{0, 0}, {1, 0}, {2, 0}}, angle);
    EXPECT_THAT(swapped.there, DoubleNear(found.back, 1e-12));
    EXPECT_THAT(swapped.back, DoubleNear(found.there, 1e-12));
  }
}

TEST(PathDifference, finds_a_millionth_of_the_length_and_nothing_between_other_divisions) {
  const double length = 3;
  for (const double angle : {0.0, 0.8}) {
    const PathDifference tip = between({{0, 0}, {1, 0}, {3, 0}}, {{0, 0}, {2, 0}, {3 - 1e-6 * length, 0}}, angle);
    EXPECT_THAT(tip.largest() / tip.scale, DoubleNear(1e-6, 1e-12));
    const PathDifference aside = between({{0, 0}, {1, 0}, {3, 0}}, {{0, 0}, {2, 1e-6 * length}, {3, 0}}, angle);
    EXPECT_THAT(aside.sideways / aside.scale, DoubleNear(1e-6, 1e-12));
    EXPECT_LT(between({{0, 0}, {1, 0}, {3, 0}}, {{3, 0}, {2.5, 0}, {0, 0}}, angle).largest(), 1e-15);
  }
}

TEST(PathDifference, counts_paths_that_the_mesh_does_not_have) {
  const auto joined = polylines(line({{0, 0}, {1, 0}}), line({{1, 0}, {1.5, 0.5}}));
  ASSERT_EQ(joined.size(), 1U);
  EXPECT_THAT(joined[0].length(), DoubleNear(1 + std::sqrt(0.5), 1e-14));
}

}  // namespace
}  // namespace sprekk
