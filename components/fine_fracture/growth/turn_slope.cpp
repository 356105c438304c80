#include "components/fine_fracture/growth/turn_slope.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sprekk::fine_fracture {

namespace {

constexpr double of_bend = 8.0 / 3;  ///< int theta/sqrt(x) dx over the root of the length, along an arc
/// Around 1/2, that of a short kink (Cotterell and Rice 1980): bounds of estimates.
constexpr double least_turn_slope = 0.3, steepest_turn_slope = 20;

}  // namespace

/// K_II is theta(0)/2 K_I - sqrt(2/pi) T int theta/sqrt(x) dx, x behind the tip: theta = 1 along a straight segment,
/// and 2 - 2x/length along an arc. K_I is not below the toughness where a tip grows, however small it is in a trial.
double turn_slope(const Sifs& sifs, double toughness, double length, bool is_bent) {
  const double end_turn = is_bent ? 2 * short_kink_turn_slope : short_kink_turn_slope, along = is_bent ? of_bend : 2;
  const double k1 = std::max(sifs.k1, toughness);
  if (!(k1 > 0)) return end_turn;
  const double slope = end_turn - along * std::sqrt(2 / std::numbers::pi) * sifs.t_stress * std::sqrt(length) / k1;
  return std::clamp(slope, least_turn_slope, steepest_turn_slope);
}

}  // namespace sprekk::fine_fracture
