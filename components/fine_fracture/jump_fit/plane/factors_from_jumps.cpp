#include "components/fine_fracture/jump_fit/plane/factors_from_jumps.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

/// (K_I, K_II) at the distance 0.
std::array<double, 2> extrapolated(std::span<const JumpBehind> jumps, double plane_modulus, double to_other_tip) {
  double distance = 0, square = 0;
  std::array<double, 2> sum = {0, 0}, moment = {0, 0};
  const double count = static_cast<double>(jumps.size());
  for (const JumpBehind& jump : jumps) {
    const double factor =
        plane_modulus / 8 * std::sqrt(2 * std::numbers::pi / (jump.distance * (1 - jump.distance / to_other_tip)));
    const std::array<double, 2> apparent = {factor * jump.opening, factor * jump.slip};
    distance += jump.distance;
    square += jump.distance * jump.distance;
    for (int k = 0; k < 2; ++k) {
      sum[k] += apparent[k];
      moment[k] += jump.distance * apparent[k];
    }
  }
  if (jumps.size() == 1) return sum;
  std::array<double, 2> factors;
  for (int k = 0; k < 2; ++k)
    factors[k] = (square * sum[k] - distance * moment[k]) / (count * square - distance * distance);
  return factors;
}

}  // namespace

FittedFactors factors_from_jumps(const std::vector<JumpBehind>& jumps, double plane_modulus, double to_other_tip) {
  SPREKK_EXPECT(!jumps.empty() && jumps.front().distance > 0);
  SPREKK_EXPECT(plane_modulus > 0, plane_modulus);
  SPREKK_EXPECT(jumps.back().distance < to_other_tip, to_other_tip);
  const auto [k1, k2] = extrapolated(jumps, plane_modulus, to_other_tip);
  double error = std::numeric_limits<double>::quiet_NaN();
  if (jumps.size() > 1) {
    const auto [one, two] = extrapolated(std::span(jumps).first(jumps.size() - 1), plane_modulus, to_other_tip);
    error = std::hypot(k1 - one, k2 - two);
  }
  return {{k1, k2, 0}, error};
}

}  // namespace sprekk::fine_fracture
