#include "components/fine_fracture/growth/mixed_mode.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

bool is_finite(const Sifs& sifs) {
  return std::isfinite(sifs.k1) && std::isfinite(sifs.k2) && std::isfinite(sifs.t_stress);
}

double tangential_sif(const Sifs& sifs, double angle) {
  const double cosine = std::cos(angle / 2);
  return cosine * (sifs.k1 * cosine * cosine - 1.5 * sifs.k2 * std::sin(angle));
}

double maximum_tangential_angle(const Sifs& sifs) {
  SPREKK_EXPECT(is_finite(sifs), sifs.k1, sifs.k2);
  if (sifs.k2 == 0) return 0;
  const double root = std::hypot(sifs.k1, std::sqrt(8.0) * sifs.k2);
  const double size = sifs.k1 >= 0 ? std::atan2(2 * std::abs(sifs.k2), sifs.k1 + root)
                                   : std::atan2(root - sifs.k1, 4 * std::abs(sifs.k2));
  return -std::copysign(2 * size, sifs.k2);
}

double equivalent_sif(const Sifs& sifs) { return std::max(0.0, tangential_sif(sifs, maximum_tangential_angle(sifs))); }

double energy_release_rate(const Sifs& sifs, double youngs_prime) {
  SPREKK_EXPECT(youngs_prime > 0, youngs_prime);
  return (sifs.k1 * sifs.k1 + sifs.k2 * sifs.k2) / youngs_prime;
}

}  // namespace sprekk::fine_fracture
