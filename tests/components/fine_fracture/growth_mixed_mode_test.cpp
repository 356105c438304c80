// The criterion of the maximum tangential stress, against tables, against a search over all directions, and its limits.
#include "components/fine_fracture/growth/mixed_mode.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace sprekk::fine_fracture {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// From closed and open, in both senses of shear, down to vanishing shear.
std::vector<Sifs> many_loads() {
  std::vector<Sifs> loads;
  for (double phase = -179; phase <= 179; phase += 3.7)
    loads.push_back({1e6 * std::cos(phase * degree), 1e6 * std::sin(phase * degree)});
  for (const double shear : {1e-3, 1e-6, 1e-9}) {
    loads.push_back({1e6, 1e6 * shear});
    loads.push_back({1e6, -1e6 * shear});
  }
  return loads;
}

TEST(MaximumTangentialStress, angle_and_equivalent_sif_of_a_slipping_fracture_with_dilation) {
  // K_I/K_II = tan(psi). Closed forms evaluated with 50 digits and rounded.
  const double dilation[] = {0, 1, 5, 10}, angle[] = {-70.53, -70.20, -68.87, -67.20},
               ratio[] = {1.1547, 1.1642, 1.2031, 1.2536};
  for (int i = 0; i < 4; ++i) {
    const Sifs sifs{std::tan(dilation[i] * degree), 1};
    EXPECT_NEAR(maximum_tangential_angle(sifs) / degree, angle[i], 0.005) << dilation[i];
    EXPECT_NEAR(equivalent_sif(sifs), ratio[i], 5e-5) << dilation[i];
  }
  EXPECT_NEAR(maximum_tangential_angle({0, 1}), -std::acos(1.0 / 3), 1e-15);
  EXPECT_NEAR(equivalent_sif({0, 1}), 2 / std::sqrt(3.0), 1e-15);
}

TEST(MaximumTangentialStress, is_the_largest_over_all_directions) {
  for (const Sifs& sifs : many_loads()) {
    const int steps = 20000;
    double best = 0;
    for (int i = 1; i < steps; ++i)
      best = std::max(best, tangential_sif(sifs, std::numbers::pi * (2.0 * i / steps - 1)));
    const double size = std::hypot(sifs.k1, sifs.k2), here = equivalent_sif(sifs);
    EXPECT_GE(here, best - 1e-14 * size) << sifs.k1 << " " << sifs.k2;
    EXPECT_LE(here, best + 1e-7 * size) << sifs.k1 << " " << sifs.k2;  // (step of the search)^2 · curvature/8
  }
}

TEST(MaximumTangentialStress, satisfies_equations_11_and_12) {
  for (const Sifs& sifs : many_loads()) {
    const double angle = maximum_tangential_angle(sifs), half = angle / 2;
    EXPECT_LT(angle * sifs.k2, 0);
    if (std::abs(sifs.k2) > 1e-2 * std::abs(sifs.k1)) {
      const double ratio = sifs.k1 / sifs.k2, sign = sifs.k2 > 0 ? -1 : 1;
      EXPECT_NEAR(angle, 2 * std::atan(ratio / 4 + sign * std::sqrt(ratio * ratio + 8) / 4), 1e-12);
      // Where shear vanishes under closure the direction tends to 180 degrees and both sides of Eq. 12 of the paper to
      // 0.
      EXPECT_LT(sifs.k2 * (std::sin(half) + 9 * std::sin(3 * half)),
                sifs.k1 * (std::cos(half) + 3 * std::cos(3 * half)))
          << sifs.k1 << " " << sifs.k2;
    }
  }
}

TEST(MaximumTangentialStress, is_exact_and_smooth_where_shear_vanishes) {
  EXPECT_EQ(maximum_tangential_angle({1, 0}), 0);
  EXPECT_EQ(equivalent_sif({1, 0}), 1);
  for (const double shear : {1e-3, 1e-8, 1e-15, 1e-300}) {
    // theta = −2 r + 14/3 r^3 + …
    EXPECT_NEAR(maximum_tangential_angle({1, shear}) / shear, -2, 5 * shear * shear + 1e-15);
    EXPECT_EQ(maximum_tangential_angle({1, -shear}), -maximum_tangential_angle({1, shear}));
  }
}

TEST(MaximumTangentialStress, mirrored_load_gives_the_mirrored_direction) {
  for (const Sifs& sifs : many_loads()) {
    EXPECT_EQ(maximum_tangential_angle({sifs.k1, -sifs.k2}), -maximum_tangential_angle(sifs));
    EXPECT_EQ(equivalent_sif({sifs.k1, -sifs.k2}), equivalent_sif(sifs));
  }
}

TEST(MaximumTangentialStress, a_closed_tip_without_shear_does_not_grow) {
  EXPECT_EQ(equivalent_sif({-1, 0}), 0);
  EXPECT_EQ(equivalent_sif({0, 0}), 0);
  EXPECT_EQ(maximum_tangential_angle({-1, 0}), 0);
  EXPECT_LT(equivalent_sif({-1, 1e-8}), 1e-20);  // falls with K_II^4/|K_I|^3
}

TEST(EnergyReleaseRate, is_that_of_irwin) {
  const double youngs_prime = 40e9 / (1 - 0.2 * 0.2);
  EXPECT_NEAR(energy_release_rate({0.7e6, 0}, youngs_prime), 11.76, 1e-12 * 11.76);
  EXPECT_DOUBLE_EQ(energy_release_rate({3e5, -4e5}, youngs_prime), energy_release_rate({5e5, 0}, youngs_prime));
}

}  // namespace
}  // namespace sprekk::fine_fracture
