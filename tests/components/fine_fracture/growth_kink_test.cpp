// Stress intensity factors after a kink, against an independent boundary-integral solution and against Cotterell and
// Rice (1980).
#include "components/fine_fracture/growth/kink.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <vector>

namespace sprekk::fine_fracture {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Angle in degrees; F11, F12, F21, F22 by boundary integrals; the same as printed by Amestoy and Leblond; C_ij.
std::vector<std::vector<double>> published() {
  std::ifstream file(SPREKK_SOURCE_DIR "/tests/components/fine_fracture/reference/kinked_crack_Fij.csv");
  std::vector<std::vector<double>> rows;
  std::string line, cell;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    rows.emplace_back();
    while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

TEST(KinkFactors, are_those_of_the_boundary_integral_solution) {
  const auto rows = published();
  ASSERT_EQ(rows.size(), 7u);
  for (const auto& row : rows) {
    const KinkFactors f = kink_factors(row[0] * degree);
    const double values[] = {f.f11, f.f12, f.f21, f.f22};
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(values[k], row[1 + k], 2.5e-5) << row[0] << " degrees, " << k;  // of that solution's extrapolation
      EXPECT_NEAR(values[k], row[5 + k], 1e-6) << row[0] << " degrees, " << k;    // digits of the table
    }
  }
}

TEST(KinkFactors, mirrored_kink_swaps_the_sign_of_shear) {
  const KinkFactors left = kink_factors(0.9), right = kink_factors(-0.9);
  EXPECT_EQ(left.f11, right.f11);
  EXPECT_EQ(left.f12, -right.f12);
  EXPECT_EQ(left.f21, -right.f21);
  EXPECT_EQ(left.f22, right.f22);
}

TEST(KinkFactors, agree_with_cotterell_and_rice_for_small_angles) {
  // C_ij is exact to first order in the angle, the diagonal to second order for K_I.
  for (const double angle : {1e-3, 1e-2, 0.1}) {
    const KinkFactors f = kink_factors(angle);
    EXPECT_NEAR(f.f11, std::pow(std::cos(angle / 2), 3), std::pow(angle, 4));
    EXPECT_NEAR(f.f12, -1.5 * angle, 2 * std::pow(angle, 3));
    EXPECT_NEAR(f.f21, 0.5 * angle, std::pow(angle, 3));
  }
}

TEST(AfterKink, t_stress_acts_as_in_cotterell_and_rice) {
  // K_II at the end of a kink of small angle: angle K_I/2 − 2 sqrt(2/pi) angle T sqrt(s) (their Eq. 35).
  const double angle = 1e-4, length = 0.02;
  const Sifs sifs{0.7e6, 0, -10e6};
  const double expected =
      angle * (sifs.k1 / 2 - 2 * std::sqrt(2 / std::numbers::pi) * sifs.t_stress * std::sqrt(length));
  EXPECT_NEAR(after_kink(sifs, angle, length).k2, expected, 1e-6 * expected);
}

TEST(LocalSymmetry, makes_shear_vanish) {
  for (const double phase : {-100.0, -90.0, -60.0, -10.0, 1.0, 30.0, 89.0}) {
    const Sifs sifs{std::cos(phase * degree), std::sin(phase * degree)};
    const double angle = local_symmetry_angle(sifs);
    EXPECT_LT(angle * sifs.k2, 0);
    EXPECT_NEAR(after_kink(sifs, angle).k2, 0, 1e-14) << phase;
    EXPECT_GT(after_kink(sifs, angle).k1, 0) << phase;
    EXPECT_EQ(local_symmetry_angle({sifs.k1, -sifs.k2}), -angle);
  }
  EXPECT_EQ(local_symmetry_angle({1, 0}), 0);
}

TEST(LocalSymmetry, pure_shear_turns_by_77_degrees) {
  EXPECT_NEAR(local_symmetry_angle({0, 1}) / degree, -77.3, 0.05);  // Amestoy and Leblond 1992
}

TEST(LocalSymmetry, is_near_the_maximum_tangential_stress_for_small_shear) {
  const Sifs sifs{1, 0.05};
  EXPECT_NEAR(local_symmetry_angle(sifs), maximum_tangential_angle(sifs), 5e-4);  // they differ by O(r^3)
}

TEST(LocalSymmetry, compression_along_the_tip_holds_longer_kinks_back) {
  const Sifs sifs{0.7e6, 0.2e6, -10e6};
  const double infinitesimal = local_symmetry_angle(sifs), finite = local_symmetry_angle(sifs, 5e-3);
  EXPECT_LT(infinitesimal, finite);
  EXPECT_LT(finite, 0);
  EXPECT_NEAR(after_kink(sifs, finite, 5e-3).k2, 0, 1e-6);
}

TEST(LocalSymmetry, tension_along_the_tip_that_outweighs_mode_one_leaves_the_infinitesimal_kink) {
  const Sifs sifs{0.7e6, 0.05e6, 10e6};
  EXPECT_EQ(local_symmetry_angle(sifs, 0.05), local_symmetry_angle(sifs, 0));
}

TEST(LargestRelease, is_between_the_two_other_criteria_in_pure_shear) {
  EXPECT_NEAR(maximum_tangential_angle({0, 1}) / degree, -70.53, 0.01);
  EXPECT_LT(local_symmetry_angle({0, 1}), largest_release_angle({0, 1}));
}

/// The polynomial through the values of boundary integrals, and where its largest value is.
TEST(LargestRelease, is_that_of_the_boundary_integral_solution) {
  const auto rows = published();
  for (const double phase : {60.0, 75.0, 90.0, 100.0}) {
    const double k1 = std::cos(phase * degree), k2 = std::sin(phase * degree);
    const auto release = [&](double angle) {
      double sum = 0;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto& f = rows[i];
        double weight = 1;
        for (std::size_t j = 0; j < rows.size(); ++j)
          if (j != i) weight *= (angle - rows[j][0]) / (f[0] - rows[j][0]);
        sum += weight * (std::pow(-f[1] * k1 + f[2] * k2, 2) + std::pow(f[3] * k1 - f[4] * k2, 2));
      }
      return sum;
    };
    double best = 30;
    for (double angle = 30; angle < 90; angle += 0.01)
      if (release(angle) > release(best)) best = angle;
    EXPECT_NEAR(largest_release_angle({k1, k2}) / degree, -best, 0.05) << phase;
    if (phase == 90) {
      EXPECT_NEAR(best, 75.76, 0.02);
    }
  }
}

TEST(LargestRelease, is_the_best_of_all_angles_and_turns_with_the_shear) {
  for (const double phase : {-100.0, -90.0, -60.0, -10.0, 1.0, 30.0, 89.0}) {
    const Sifs sifs{std::cos(phase * degree), std::sin(phase * degree)};
    const double angle = largest_release_angle(sifs);
    EXPECT_LT(angle * sifs.k2, 0);
    EXPECT_NEAR(largest_release_angle({sifs.k1, -sifs.k2}), -angle, 1e-12);
    const Sifs here = after_kink(sifs, angle);
    EXPECT_GT(here.k1, 0);
    for (double other = -85 * degree; other < 85 * degree; other += 0.01) {
      const Sifs there = after_kink(sifs, other);
      if (there.k1 > 0) {
        EXPECT_LE(std::hypot(there.k1, there.k2), std::hypot(here.k1, here.k2) * (1 + 1e-12)) << phase;
      }
    }
    // Within 2 degrees of where K_II vanishes, and a hair more or less shear turns it by a hair.
    EXPECT_NEAR(angle, local_symmetry_angle(sifs), 2 * degree) << phase;
    EXPECT_NEAR(largest_release_angle({sifs.k1, sifs.k2 * (1 + 1e-9)}), angle, 1e-7) << phase;
  }
  EXPECT_EQ(largest_release_angle({1, 0}), 0);
  EXPECT_EQ(largest_release_angle({-1, 0.01}), 0);
}

}  // namespace
}  // namespace sprekk::fine_fracture
