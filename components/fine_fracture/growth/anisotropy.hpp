// Toughness that differs with the direction of growth.
#pragma once

#include "components/fine_fracture/growth/mixed_mode.hpp"
#include "framework/config/spec.hpp"

namespace sprekk::fine_fracture {

/// G_c(theta) = G_c0 (1 + A cos^2(theta - theta_0)) for growth in the direction theta, from the x axis. A smooth crack
/// grows where G(theta)/G_c(theta) is largest straight ahead, and is 1 (Hakim and Karma, J. Mech. Phys. Solids 57
/// (2009) 342). Under pure mode I, G falls with the angle psi of a kink as 1 - psi^2/2, so straight ahead is no maximum
/// in some direction unless G_c + G_c'' > 0 in all: -1/2 < A < 1, weak anisotropy (Takei, Roman, Bico, Hamm and Melo,
/// Phys. Rev. Lett. 110 (2013) 144301).
struct Anisotropy {
  static constexpr double low = -0.5, high = 1;  ///< of A, exclusive: exact, Takei and others 2013
  double strength = 0;                           ///< A
  double direction = 0;                          ///< theta_0, rad
  Spec spec();
  /// K_IC for growth in this direction (rad from the x axis) over that across theta_0.
  double toughness(double angle) const;
  double smallest() const;  ///< of toughness
};

/// Translates the factors of a tip in anisotropic rock, whose path ends in the direction `ahead` (rad from the x axis),
/// into those for which isotropic rock gives the same answer. They have K_II = 0 where G/G_c is largest straight ahead;
/// otherwise their K_II vanishes behind the infinitesimal kink for which it is largest. Their K_eq over the toughness
/// straight ahead is the root of the largest G/G_c. In isotropic rock they are the given factors.
Sifs felt_sifs(const Sifs& sifs, double ahead, const Anisotropy& anisotropy);

}  // namespace sprekk::fine_fracture
