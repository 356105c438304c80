// The opening near a tip that moves with a speed, between toughness and viscosity.
#pragma once

namespace sprekk::fine_fracture {

/// A semi-infinite crack in impermeable rock that moves with a speed V and is full of a viscous fluid to its tip
/// (Garagash and Detournay, J. Appl. Mech. 67 (2000) 183; Dontsov and Peirce, J. Fluid Mech. 781 (2015) R3). At the
/// distance s from the tip
///   w^3 = A^3 s^(3/2) + B s^2 (c + (12 pi − c) A^3/(A^3 + 70 B sqrt(s))),   c = 2·3^(5/2),
/// A = K'/E', K' = 4 sqrt(2/pi) K_IC, and B = mu' V/E', mu' = 12 mu: exact at both ends, within 0.12 % between them
/// (tests/verification/references/near_tip.py). With c in place of the bracket it would be 1.1 % off in w, and 21 % in
/// V.
struct ViscousTip {
  double toughness;      ///< K_IC, Pa sqrt(m)
  double plane_modulus;  ///< E', Pa
  double viscosity;      ///< mu, Pa s

  double opening(double distance, double speed) const;     ///< m, at a distance (m) behind a tip with a speed (m/s)
  double mean_opening(double length, double speed) const;  ///< m, over the last length (m) before the tip
  /// The speed (m/s) with which the mean opening is this one; 0 where the opening is that of a tip at rest or less.
  double speed(double mean_opening, double length) const;
  /// The mean opening over that of a tip at rest: how many times the toughness K_eq has to be, where K_eq is that of a
  /// crack with w ~ sqrt(s) and the same mean opening. Not below 1.
  double apparent_toughness(double length, double speed) const;
};

}  // namespace sprekk::fine_fracture
