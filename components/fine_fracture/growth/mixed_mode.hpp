// The criterion of the maximum tangential stress for a tip in mixed mode (sec. 2.5 of the paper; Erdogan and Sih 1963).
//
// Frame of a tip: x1 ahead of it, x2 = x1 turned by +90 degrees. K_I > 0 opens. K_II > 0 when the wall at x2 > 0 moves
// to +x1 relative to the other. Angles count from x1 towards x2, rad. In this frame Eqs. 10 to 12 of the paper hold as
// they are printed. Of the two signs in the paper's Eq. 11 the lower one belongs to K_II > 0 and the upper one to
// K_II < 0, so that the angle always has the sign opposite to K_II. The paper's Eq. 12 (a maximum, not a minimum)
// selects the same root.
#pragma once

namespace sprekk::fine_fracture {

/// Stress intensity factors of a tip, Pa sqrt(m), and its T-stress, Pa: by how much sigma_11 of the walls next to the
/// tip exceeds their sigma_22 (which is −p under a fluid pressure p). A T-stress of 0 stands for an unknown one: the
/// directions of growth then take more trials.
struct Sifs {
  double k1 = 0, k2 = 0;
  double t_stress = 0;
};

bool is_finite(const Sifs& sifs);  ///< K_I, K_II and the T-stress

/// Eq. 10 of the paper times sqrt(2 pi r): the tangential stress in the direction `angle`.
double tangential_sif(const Sifs& sifs, double angle);

/// The direction of growth theta_0, in (−pi, pi): Eq. 11 of the paper, which divides by K_II; its conjugate
///   tan(theta_0/2) = −2 K_II/(K_I + sqrt(K_I^2 + 8 K_II^2))
/// does not, and goes smoothly to 0 with K_II. For K_I < 0 the form of the paper's Eq. 11 is the one without
/// cancellation. The angle is 0 where no direction is tensile (K_II = 0, K_I <= 0).
double maximum_tangential_angle(const Sifs& sifs);

/// K_eq, the largest tangential_sif: the tip grows when K_eq reaches K_IC. K_eq is never negative, and 0 where no
/// direction is tensile; then the tip does not grow.
double equivalent_sif(const Sifs& sifs);

/// G = (K_I^2 + K_II^2)/E' (J/m^2), E' = E/(1 − nu^2) in plane strain (Irwin 1957).
double energy_release_rate(const Sifs& sifs, double youngs_prime);

}  // namespace sprekk::fine_fracture
