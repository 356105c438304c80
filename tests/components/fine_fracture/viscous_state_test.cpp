// The state of a tip whose fluid holds it back, for the search for a front.
#include "components/fine_fracture/growth/viscous_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "components/fine_fracture/growth/viscous_tip.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr double scale = 2e6;  // Pa sqrt(m)

FrontState state(double k1, double k2 = 0) { return {{k1, k2, -1e6}, 17, true}; }

double excess(double k1, double toughness) { return *against_viscosity(state(k1), toughness, scale).excess; }

TEST(ViscousState, is_at_its_load_where_K_is_the_apparent_toughness) {
  EXPECT_DOUBLE_EQ(against_viscosity(state(1.4e6), 1.4e6, scale).load, 1);
  EXPECT_NEAR(against_viscosity(state(2.8e6), 1.4e6, scale).load, 2, 1e-12);
  EXPECT_NEAR(excess(1.4e6, 1.4e6), 0, 1e-15);
}

TEST(ViscousState, falls_with_K_in_proportion_also_below_zero) {
  EXPECT_NEAR(excess(3e6, 1e6), 1, 1e-12);
  EXPECT_NEAR(excess(0, 1e6), -0.5, 1e-12);
  EXPECT_NEAR(excess(-2e6, 1e6), -1.5, 1e-12);
}

TEST(ViscousState, direction_is_continuous_where_K_I_passes_zero) {
  const auto shear = [](double k1) {
    const Sifs sifs = against_viscosity(state(k1, 2e4), 1e6, scale).sifs;
    return std::atan2(sifs.k2, sifs.k1);
  };
  EXPECT_NEAR(shear(-1e5), 0.02, 1e-5);
  EXPECT_NEAR(shear(1e5), 0.02, 1e-5);
  EXPECT_NEAR(shear(1e6), 0.02, 1e-5);
}

TEST(ViscousState, leaves_tips_that_are_not_evaluated) {
  FrontState unknown{{}, 0.3, false};
  EXPECT_EQ(against_viscosity(unknown, 1e6, scale).load, 0.3);
  EXPECT_FALSE(against_viscosity(unknown, 1e6, scale).excess);
}

/// One tip in a fluid, whose K falls in proportion to its advance, with a toughness from none that counts (1e-6) to one
/// that rules: the search finds the advance with which K is the apparent toughness at its speed, as bisection does.
TEST(ViscousState, advance_is_found_from_viscosity_to_toughness) {
  constexpr double falls = 5e7, dt = 0.04, cell = 0.5;  // Pa/sqrt(m), s, m
  for (const double ratio : {1e-6, 1e-2, 1.0})
    for (const double at_start : {2.2e6, 3e6, 4.5e6}) {
      const ViscousTip moving{1.2e6 * ratio, 3.2e10, 1e-3};
      const auto apparent = [&](double length) {
        return moving.toughness * moving.apparent_toughness(cell, std::max(0.0, length - 0.1) / dt);
      };
      const auto k = [&](double length) { return at_start - falls * (length - 0.1); };
      FrontTip tip;
      tip.covered = 0.1;
      tip.toughness = moving.toughness;
      tip.longest = 0.85;
      FrontOptions options;
      options.increment = 0.5;
      options.shortest = 5e-3;
      const auto at = [&](double length, double angle) {
        return std::vector<FrontState>{
            against_viscosity({{k(length), 1e6 * angle, -1e6}, 0}, apparent(length), 1.2e6 * (1 + ratio))};
      };
      tip.goes_on = true;
      tip.speed = 1.5;
      Front front({tip}, at(0.1, 0), options, dt);
      while (front.verdict() == Front::Verdict::again) front.learn(at(front.length(0), front.angle(0)));
      ASSERT_EQ(front.verdict(), Front::Verdict::found) << ratio << " " << at_start;
      double low = 0.1, high = 0.85;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (k(middle) > apparent(middle) ? low : high) = middle;
      }
      EXPECT_NEAR(front.length(0), low, 2e-7 * 0.5) << ratio << " " << at_start;
      EXPECT_LE(front.trials(), 9) << ratio << " " << at_start;
    }
}

}  // namespace
}  // namespace sprekk::fine_fracture
