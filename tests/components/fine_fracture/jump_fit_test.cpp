// Stress intensity factors from jumps behind a tip, against jumps of known factors.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "components/fine_fracture/jump_fit/plane/factors_from_jumps.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr double plane_modulus = 40e9, infinity = std::numeric_limits<double>::infinity();

/// 8/E' sqrt(r (1 − r/length)/(2 pi)) (K + slope r) in the middles of cells of h.
std::vector<JumpBehind> jumps_of(double k1, double k2, double slope, double length, double h, int count) {
  std::vector<JumpBehind> jumps;
  for (int i = 0; i < count; ++i) {
    const double r = (i + 0.5) * h;
    const double unit = 8 / plane_modulus * std::sqrt(r * (1 - r / length) / (2 * M_PI));
    jumps.push_back({r, unit * (k1 + slope * r), unit * (k2 - 2 * slope * r)});
  }
  return jumps;
}

TEST(FactorsFromJumps, areThoseOfTractionsThatAreConstantOrLinear) {
  for (const double length : {infinity, 0.1, 0.07})
    for (const double slope : {0.0, 3e6, -7e6})
      for (const int count : {2, 3, 4}) {
        const FittedFactors found =
            factors_from_jumps(jumps_of(0.7e6, -0.3e6, slope, length, 0.01, count), plane_modulus, length);
        EXPECT_NEAR(found.sifs.k1, 0.7e6, 1e-3) << length << " " << slope << " " << count;
        EXPECT_NEAR(found.sifs.k2, -0.3e6, 1e-3) << length << " " << slope << " " << count;
        EXPECT_EQ(std::isnan(found.error), false);
        if (count > 2) {
          EXPECT_LT(found.error, 1e-3);
        }
      }
}

TEST(FactorsFromJumps, ofOnePlaceAreWithoutAnError) {
  const FittedFactors found =
      factors_from_jumps(jumps_of(0.7e6, -0.3e6, 0, infinity, 0.01, 1), plane_modulus, infinity);
  EXPECT_NEAR(found.sifs.k1, 0.7e6, 1e-3);
  EXPECT_TRUE(std::isnan(found.error));
}

// A crack of half-length a under constant stress has K = s sqrt(pi a), and the jumps 4 s/E' sqrt(a^2 − x^2).
TEST(FactorsFromJumps, areThoseOfTheCrackOfGriffith) {
  const double a = 0.05, stress = 2e6;
  for (const int cells : {5, 10, 37}) {
    std::vector<JumpBehind> jumps;
    for (int i = 1; i < 4 && 2 * i < cells; ++i) {
      const double r = (i + 0.5) * 2 * a / cells;
      jumps.push_back({r, 4 * stress / plane_modulus * std::sqrt(a * a - (a - r) * (a - r)), 0});
    }
    EXPECT_NEAR(factors_from_jumps(jumps, plane_modulus, 2 * a).sifs.k1 / (stress * std::sqrt(M_PI * a)), 1, 1e-12);
  }
}

}  // namespace
}  // namespace sprekk::fine_fracture
