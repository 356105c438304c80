// The search for an increment, over many loads of a tip in shear whose kink turns far and closes with its length.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "components/fine_fracture/growth/grow_tips.hpp"
#include "components/fine_fracture/growth/kink.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr double toughness = 0.7e6;

/// A tip whose first kink has the factors of an infinitesimal one, and a uniform field that presses it together and
/// turns it: with the angle phi of the kink to the larger compression and the length s,
///   K_I = F_1j K_j − D sin^2(phi) sqrt(pi s/2),   K_II = F_2j K_j − (D/2) sin(2 phi) sqrt(pi s/2).
/// A long kink in a wrong direction is closed, and its K_eq comes from K_II alone.
struct PressedTip {
  Sifs start;
  double difference;   ///< D, Pa
  double compression;  ///< the direction of the larger compression, rad

  Sifs at(const Point& end) const {
    const double angle = std::atan2(end[1], end[0]), grows = std::sqrt(std::numbers::pi * end.norm() / 2);
    const double turn = angle - compression;
    const KinkFactors f = kink_factors(angle);
    return {f.f11 * start.k1 + f.f12 * start.k2 - difference * std::sin(turn) * std::sin(turn) * grows -
                0.02 * difference * grows,
            f.f21 * start.k1 + f.f22 * start.k2 + 0.5 * difference * std::sin(2 * turn) * grows, 0};
  }
};

/// The length at which a kink without K_II at its end has the toughness, by bisection within bisection; 0 where even
/// the shortest kink is below it.
double length_of_arrest(const PressedTip& tip, double toughness, double longest) {
  const auto k_eq = [&](double length) {
    // From the angle of an infinitesimal kink towards the compression K_II changes its sign once.
    double low = local_symmetry_angle(tip.start, 0, 1.4), high = tip.compression;
    const auto end = [&](double angle) { return tip.at({length * std::cos(angle), length * std::sin(angle)}); };
    const double sign = std::copysign(1.0, end(high).k2);
    for (int i = 0; i < 45; ++i) {
      const double middle = (low + high) / 2;
      (end(middle).k2 * sign > 0 ? high : low) = middle;
    }
    return end(low).k1;
  };
  double low = 1e-9, high = longest;
  if (k_eq(low) < toughness) return 0;
  for (int i = 0; i < 45; ++i) {
    const double middle = (low + high) / 2;
    (k_eq(middle) > toughness ? low : high) = middle;
  }
  return low;
}

TEST(IncrementSearch, FindsTheArrestOfTipsThatAreClosedInMostDirections) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  int grown = 0, going_on = 0;
  for (int i = 0; i < 600; ++i) {
    const double mirror = i % 2 == 0 ? 1 : -1;
    const double excess = 1 + 0.3 * std::pow(unit(random), 2);
    // K_eq = 1.1547 K_II for K_I = 0.
    const PressedTip tip{{0.02e6 * unit(random), mirror * excess * 0.606e6, 0},
                         (5 + 20 * unit(random)) * 1e6,
                         -mirror * (0.6 + 0.4 * unit(random))};
    GrowthOptions options;
    options.increment = std::pow(10, -3 + 1.5 * unit(random));
    const GrowingTip growing{
        .tip = Point(0, 0), .direction = Point(1, 0), .toughness = toughness, .youngs_prime = 4e10, .path = {}};
    const auto sifs = [&](int, const std::vector<TipPath>& paths) {
      return paths[0].added.empty() ? tip.start : tip.at(paths[0].added.back());
    };
    options.at_most = 1;
    const TipOutcome outcome =
        grow_tips({growing}, options, sifs, [](int, const TipPath&, const Point&) { return 1e9; })[0];
    const double exact = length_of_arrest(tip, 0.99 * toughness, 10);
    EXPECT_LE(outcome.evaluations, 40);
    EXPECT_TRUE(outcome.notes.empty()) << i << ": " << outcome.notes[0];
    if (outcome.increments == 0) {
      EXPECT_LT(exact, 1.1 * options.smallest_length()) << i;  // it waits
      continue;
    }
    ++grown;
    EXPECT_LE(std::abs(outcome.end.k2), 0.0101 * outcome.end.k1) << i;
    EXPECT_GE(equivalent_sif(outcome.end), 0.99 * toughness) << i;
    // It ends at the toughness, or goes on with the next increment: this is rare here, except where a whole increment
    // is too short.
    const bool goes_on = equivalent_sif(outcome.end) > 1.01 * toughness;
    if (goes_on && outcome.length < options.increment) ++going_on;
    EXPECT_EQ(goes_on, outcome.reason.find("largest number of increments") != std::string::npos) << outcome.reason;
    EXPECT_LT(outcome.length, 1.02 * exact) << i;
  }
  EXPECT_GT(grown, 300);
  EXPECT_LT(going_on, 0.02 * grown);
}

}  // namespace
}  // namespace sprekk::fine_fracture
