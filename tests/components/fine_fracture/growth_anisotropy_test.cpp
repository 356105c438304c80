// Toughness that differs with direction: the kink for which G/G_c is largest, by the published factors of kinks, and
// the condition of Hakim and Karma (2009) for smooth cracks.
#include "components/fine_fracture/growth/anisotropy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <vector>

#include "components/fine_fracture/growth/kink.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr double degree = std::numbers::pi / 180;

Anisotropy anisotropy(double strength, double direction) {
  Anisotropy made;
  made.strength = strength;
  made.direction = direction;
  return made;
}

/// ln(G/K_I^2) of kinks under pure K_I, even in the angle: through 0 and the values at 15 to 75 degrees of a solution
/// by boundary integrals.
double log_release(double angle) {
  static const auto rows = [] {
    std::ifstream file(SPREKK_SOURCE_DIR "/tests/components/fine_fracture/reference/kinked_crack_Fij.csv");
    std::vector<std::pair<double, double>> values{{0, 0}};
    std::string line, cell;
    std::getline(file, line);
    while (std::getline(file, line) && values.size() < 6) {
      std::stringstream cells(line);
      double row[5];
      for (double& value : row) {
        std::getline(cells, cell, ',');
        value = std::stod(cell);
      }
      values.emplace_back(std::pow(row[0] * degree, 2), std::log(row[1] * row[1] + row[3] * row[3]));
    }
    return values;
  }();
  double sum = 0;
  for (const auto& [place, value] : rows) {
    double product = value;
    for (const auto& [other, ignored] : rows)
      if (other != place) product *= (angle * angle - other) / (place - other);
    sum += product;
  }
  return sum;
}

struct Largest {
  double angle, value;  ///< rad; of G/G_c over that straight ahead
};

Largest largest_by_table(double strength, double direction, double ahead) {
  const auto held = [&](double angle) { return 1 + strength * std::pow(std::cos(angle - direction), 2); };
  Largest best{0, 1};
  for (double kink = -1.2; kink <= 1.2; kink += 1e-4) {
    const double value = std::exp(log_release(kink)) * held(ahead) / held(ahead + kink);
    if (value > best.value) best = {kink, value};
  }
  return best;
}

TEST(Anisotropy, lets_a_crack_under_tension_kink_to_the_largest_release_over_its_cost) {
  int turned = 0;
  for (const double strength : {-0.4, -0.2, 0.1, 0.3, 0.8})
    for (const double direction : {0.0, 20.0, 45.0, 80.0, -35.0})
      for (const double ahead : {0.0, 100.0}) {
        const Largest right = largest_by_table(strength, direction * degree, ahead * degree);
        const Sifs felt = felt_sifs({2, 0}, ahead * degree, anisotropy(strength, direction * degree));
        EXPECT_NEAR(local_symmetry_angle(felt) / degree, right.angle / degree, 0.05) << strength << " " << direction;
        EXPECT_NEAR(equivalent_sif(felt) / 2, std::sqrt(right.value), 2e-5) << strength << " " << direction;
        if (std::abs(right.angle) > 5 * degree) ++turned;
      }
  EXPECT_GT(turned, 20);
}

TEST(Anisotropy, has_no_shear_where_a_smooth_crack_goes_straight) {
  for (const double strength : {-0.4, 0.2, 0.7})
    for (const double ahead : {10.0, 40.0, 130.0, -70.0}) {
      const double twice = 2 * (ahead - 15) * degree;
      // d ln G/d psi = -2 K_I K_II/(K_I^2 + K_II^2) is d ln G_c/d theta.
      const double slope = -strength * std::sin(twice) / (1 + 0.5 * strength * (1 + std::cos(twice)));
      const double shear = -std::tan(0.5 * std::asin(slope));
      const Sifs sifs{1, shear}, felt = felt_sifs(sifs, ahead * degree, anisotropy(strength, 15 * degree));
      EXPECT_NEAR(felt.k2, 0, 1e-7) << strength << " " << ahead;
      EXPECT_NEAR(felt.k1, std::hypot(1, shear), 1e-9) << strength << " " << ahead;
      const double other = felt_sifs({1, shear + 0.1}, ahead * degree, anisotropy(strength, 15 * degree)).k2;
      EXPECT_GT(other, 0.03) << strength << " " << ahead;
    }
}

TEST(Anisotropy, turns_and_mirrors_with_the_rock) {
  for (const double shear : {-0.6, 0.0, 0.3}) {
    const Sifs one = felt_sifs({1, shear, 5}, 0.3, anisotropy(0.5, 0.9));
    const Sifs turned = felt_sifs({1, shear, 5}, 1.4, anisotropy(0.5, 2.0));
    EXPECT_NEAR(turned.k1, one.k1, 1e-9);
    EXPECT_NEAR(turned.k2, one.k2, 1e-9);
    const Sifs mirrored = felt_sifs({1, -shear, 5}, -0.3, anisotropy(0.5, -0.9));
    EXPECT_NEAR(mirrored.k1, one.k1, 1e-9);
    EXPECT_NEAR(mirrored.k2, -one.k2, 1e-9);
    EXPECT_EQ(one.t_stress, 5);
    const Sifs perturbed = felt_sifs({1 + 1e-9, shear, 5}, 0.3, anisotropy(0.5, 0.9));
    EXPECT_NEAR(perturbed.k2, one.k2, 2e-8);
  }
}

TEST(Anisotropy, of_no_strength_changes_nothing) {
  const Sifs felt = felt_sifs({1.3, -0.4, 7}, 0.3, Anisotropy());
  EXPECT_EQ(felt.k1, 1.3);
  EXPECT_EQ(felt.k2, -0.4);
  EXPECT_EQ(felt.t_stress, 7);
}

TEST(Anisotropy, does_not_open_walls_that_touch) {
  EXPECT_EQ(equivalent_sif(felt_sifs({-1, 0}, 0.3, anisotropy(0.5, 0.9))), 0);
}

}  // namespace
}  // namespace sprekk::fine_fracture
