#include "components/fine_fracture/growth/viscous_tip.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

const double near_viscosity = 18 * std::sqrt(3), near_toughness = 12 * std::acos(-1);
constexpr double transition = 70;  // the opening is then within 0.12 % of the exact one (viscous_tip.hpp)

/// K'/E'; cubed it is the factor of s^(3/2).
double toughness_factor(const ViscousTip& tip) {
  return 4 * std::sqrt(2 / std::numbers::pi) * tip.toughness / tip.plane_modulus;
}

}  // namespace

double ViscousTip::opening(double distance, double speed) const {
  SPREKK_EXPECT(distance >= 0 && speed >= 0, distance, speed);
  if (distance == 0) return 0;
  const double root = std::sqrt(distance), cube = std::pow(toughness_factor(*this), 3);
  const double b = 12 * viscosity * speed / plane_modulus;
  const double share = cube > 0 ? cube / (cube + transition * b * root) : 0;
  const double factor = near_viscosity + (near_toughness - near_viscosity) * share;
  return std::cbrt(distance * root * (cube + b * factor * root));
}

/// With s = h u^2 the integrand is u sqrt(h) times a smooth function of u: Gauss' rule with 10 points.
double ViscousTip::mean_opening(double length, double speed) const {
  SPREKK_EXPECT(length > 0, length);
  constexpr std::array<double, 5> place = {0.148874338981631211, 0.433395394129247191, 0.679409568299024406,
                                           0.865063366688984511, 0.973906528517171720};
  constexpr std::array<double, 5> weight = {0.295524224714752870, 0.269266719309996355, 0.219086362515982044,
                                            0.149451349150580593, 0.066671344308688138};
  double sum = 0;
  for (int i = 0; i < 5; ++i)
    for (const double side : {-1.0, 1.0}) {
      const double u = 0.5 * (1 + side * place[i]);
      sum += 0.5 * weight[i] * 2 * u * opening(length * u * u, speed);
    }
  return sum;
}

double ViscousTip::speed(double mean, double length) const {
  SPREKK_EXPECT(viscosity > 0, viscosity);
  if (!(mean > mean_opening(length, 0))) return 0;
  // Without toughness the mean would be 3/5 of the opening at the end, and the speed the largest that it can be.
  const double viscous_only = std::pow(5 * mean / 3, 3) / (length * length) * plane_modulus / (12 * viscosity);
  double low = 0, high = viscous_only / near_viscosity;
  constexpr int halvings = 60;  // from the whole interval to round-off
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (mean_opening(length, middle) < mean ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double ViscousTip::apparent_toughness(double length, double speed) const {
  SPREKK_EXPECT(toughness > 0, toughness);
  return mean_opening(length, speed) / mean_opening(length, 0);
}

}  // namespace sprekk::fine_fracture
