#include "framework/picture/axis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sprekk {
namespace {

using testing::ElementsAre;

std::vector<std::string> texts(const Axis& axis) {
  std::vector<std::string> result;
  for (const Tick& tick : axis.ticks()) result.push_back(tick.text);
  return result;
}

TEST(Axis, has_round_ticks_with_the_digits_that_they_need) {
  EXPECT_THAT(texts(Axis({0, 10}, Axis::Scale::linear, 5)), ElementsAre("0", "5", "10"));
  EXPECT_THAT(texts(Axis({-0.1, 0.1}, Axis::Scale::linear, 5)), ElementsAre("-0.10", "-0.05", "0.00", "0.05", "0.10"));
  EXPECT_THAT(texts(Axis({1e6, 1e6 + 4}, Axis::Scale::linear, 5)),
              ElementsAre("1000000", "1000001", "1000002", "1000003", "1000004"));
}

TEST(Axis, holds_all_values_and_maps_them_linearly) {
  const Axis axis({2, 3, 7}, Axis::Scale::linear, 5);
  EXPECT_GT(axis.fraction(2), 0);
  EXPECT_LT(axis.fraction(7), 1);
  EXPECT_NEAR(axis.fraction(4.5), 0.5, 1e-14);
}

TEST(Axis, gives_equal_values_and_no_values_a_range) {
  const Axis equal({5, 5 + 1e-12}, Axis::Scale::linear, 5);
  EXPECT_LT(equal.low(), 5);
  EXPECT_GT(equal.high(), 5);
  EXPECT_GE(equal.ticks().size(), 2U);
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (const auto scale : {Axis::Scale::linear, Axis::Scale::logarithmic}) {
    EXPECT_GE(Axis({}, scale, 5).ticks().size(), 2U);
    EXPECT_GE(Axis({nothing, 0, 0}, scale, 5).ticks().size(), 2U);
  }
}

TEST(Axis, has_decades_on_a_logarithmic_scale) {
  const Axis axis({1e-3, 0, 10}, Axis::Scale::logarithmic, 5);
  EXPECT_THAT(texts(axis), ElementsAre("10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹"));
  EXPECT_NEAR(axis.fraction(0.1), 0.5, 1e-14);
  EXPECT_TRUE(std::isnan(axis.fraction(0)));
}

}  // namespace
}  // namespace sprekk
