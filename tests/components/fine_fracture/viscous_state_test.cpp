// The state of a tip whose fluid holds it back, for the search for a front.
#include "components/fine_fracture/growth/viscous_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sprekk::fine_fracture {
namespace {

FrontState state(double k1, double k2 = 0) { return {{k1, k2, -1e6}, 17, true}; }

double log_load(double k1, double toughness) { return std::log(against_viscosity(state(k1), toughness).load); }

TEST(ViscousState, is_at_its_load_where_K_is_the_apparent_toughness) {
  EXPECT_DOUBLE_EQ(against_viscosity(state(1.4e6), 1.4e6).load, 1);
  EXPECT_NEAR(against_viscosity(state(2.8e6), 1.4e6).load, 2, 1e-12);
}

TEST(ViscousState, falls_with_K_in_proportion_also_below_zero) {
  EXPECT_NEAR(log_load(0.5e6, 1e6), -0.5, 1e-12);
  EXPECT_NEAR(log_load(0, 1e6), -1, 1e-12);
  EXPECT_NEAR(log_load(-2e6, 1e6), -3, 1e-12);
  // One slope on both sides of the toughness.
  EXPECT_NEAR((log_load(1.001e6, 1e6) - log_load(1e6, 1e6)) / (log_load(1e6, 1e6) - log_load(0.999e6, 1e6)), 1, 2e-3);
}

TEST(ViscousState, direction_is_continuous_where_K_I_passes_zero) {
  const auto shear = [](double k1) {
    const Sifs sifs = against_viscosity(state(k1, 2e4), 1e6).sifs;
    return std::atan2(sifs.k2, sifs.k1);
  };
  EXPECT_NEAR(shear(-1e5), 0.02, 1e-5);
  EXPECT_NEAR(shear(1e5), 0.02, 1e-5);
  EXPECT_NEAR(shear(1e6), 0.02, 1e-5);
}

TEST(ViscousState, leaves_tips_that_are_not_evaluated) {
  FrontState unknown{{}, 0.3, false};
  EXPECT_EQ(against_viscosity(unknown, 1e6).load, 0.3);
}

}  // namespace
}  // namespace sprekk::fine_fracture
