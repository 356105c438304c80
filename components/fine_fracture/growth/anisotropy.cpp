#include "components/fine_fracture/growth/anisotropy.hpp"

#include <algorithm>
#include <cmath>

#include "components/fine_fracture/growth/kink.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double largest_kink = 1.3;  ///< rad: a little further, behind kinks of pure K_II, no K_II vanishes

}  // namespace

Spec Anisotropy::spec() {
  Spec spec(
      "toughness_anisotropy",
      "Toughness that differs with the direction of growth: G_c = K_IC^2/E' times 1 + strength cos^2(angle between "
      "growth and `direction`). Tips grow where G/G_c is largest. Without it rock is as tough in all directions.");
  spec.quantity("strength", strength,
                {.doc = "By which part G_c along `direction` exceeds that across it: above -0.5 and below 1 (weak "
                        "anisotropy). Along bedding that is half as tough it is -0.49.",
                 .source = "Takei et al. 2013"});
  spec.quantity("direction", direction,
                {.unit = "rad", .doc = "From the x axis, counter-clockwise.", .source = "Hakim and Karma 2009"});
  return spec;
}

double Anisotropy::toughness(double angle) const {
  const double along = std::cos(angle - direction);
  return std::sqrt(1 + strength * along * along);
}

double Anisotropy::smallest() const { return std::sqrt(1 + std::min(0.0, strength)); }

Sifs felt_sifs(const Sifs& sifs, double ahead, const Anisotropy& anisotropy) {
  if (anisotropy.strength == 0) return sifs;
  const double straight = anisotropy.toughness(ahead);
  const auto resistance = [&](double kink) { return anisotropy.toughness(ahead + kink) / straight; };
  const double kink = largest_release_angle(sifs, largest_kink, resistance);
  const Sifs behind = after_kink(sifs, kink);
  if (!(behind.k1 > 0)) return {std::min(0.0, sifs.k1), 0, sifs.t_stress};
  const KinkFactors f = kink_factors(kink);
  Sifs felt{f.f22, -f.f21, sifs.t_stress};
  const double scale = std::hypot(behind.k1, behind.k2) / resistance(kink) / equivalent_sif(felt);
  felt.k1 *= scale;
  felt.k2 *= scale;
  return felt;
}

}  // namespace sprekk::fine_fracture
