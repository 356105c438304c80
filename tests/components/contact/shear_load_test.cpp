#include "components/contact/shear_load.hpp"

#include <gtest/gtest.h>

namespace sprekk::contact {
namespace {

TEST(ShearLoad, IsShearOverNormalTractionAndOverWhatWallsHold) {
  for (const double sign : {1.0, -1.0}) {
    const ShearLoad load = shear_load({-20e6, sign * 6e6}, {.friction = 0.6, .cohesion = 3e6}, false);
    EXPECT_DOUBLE_EQ(load.slip_tendency, 0.3);
    EXPECT_DOUBLE_EQ(load.friction_used, 6.0 / (3 + 12));
  }
}

TEST(ShearLoad, OfWallsThatSlideUntilTheyPartIsContinuous) {
  const Strength strength{.friction = 0.6};
  const ShearLoad nearly = shear_load({-1e-3, 0.6e-3}, strength, false), parted = shear_load({0, 0}, strength, true);
  EXPECT_DOUBLE_EQ(nearly.slip_tendency, parted.slip_tendency);
  EXPECT_DOUBLE_EQ(nearly.friction_used, 1);
  EXPECT_DOUBLE_EQ(parted.friction_used, 1);
  // What is left of tractions on walls that have parted is round-off.
  EXPECT_DOUBLE_EQ(shear_load({-1e-9, 1e-12}, strength, true).friction_used, 1);
}

TEST(ShearLoad, OfWallsThatTouchWithoutALoadIsNothing) {
  for (const double friction : {0.6, 0.0}) {
    const ShearLoad load = shear_load({0, 0}, {.friction = friction}, false);
    EXPECT_EQ(load.slip_tendency, 0);
    EXPECT_EQ(load.friction_used, 0);
  }
}

}  // namespace
}  // namespace sprekk::contact
