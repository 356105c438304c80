// Stress intensity factors at the end of a short straight kink, from those of the tip before it kinks.
#pragma once

#include <functional>

#include "components/fine_fracture/growth/mixed_mode.hpp"

namespace sprekk::fine_fracture {

/// The factors F_ij of an infinitesimal kink: its stress intensity factors are k_i = F_ij(angle) K_j.
struct KinkFactors {
  double f11, f12, f21, f22;
};

/// The series of Amestoy and Leblond (Int. J. Solids Struct. 29 (1992) 465, table 1) in angle/pi, to its 20th power:
/// for |angle| <= 90 degrees within 2e-5 of their integral equations.
KinkFactors kink_factors(double angle);

/// The first two terms of the expansion in the length s (m) of a straight kink:
///   k_i(s) = F_ij K_j + T sqrt(s) G_i(angle),
/// G_i from table 2 of Amestoy and Leblond. The t_stress of the result is that of the tip before. The result is
/// accurate for |T| sqrt(s) well below K_I; beyond, it is a guess with the right trend.
Sifs after_kink(const Sifs& sifs, double angle, double length = 0);

/// The angle (rad, at most `limit` in size) of the straight kink of this length at whose end K_II vanishes: the root of
/// after_kink next to 0 on the side opposite to K_II. Without a root it is the largest angle on that side, if K_II
/// still decreases towards it. Otherwise, under a tensile T that outweighs K_I (kinks that turn away from mode I), it
/// is the angle of an infinitesimal kink. A length of 0 is the principle of local symmetry (Goldstein and Salganik
/// 1974).
double local_symmetry_angle(const Sifs& sifs, double length = 0, double limit = 1.5);

/// The longest kink (m, between `low` and `high`) in the direction of local symmetry at whose end K_eq is still above
/// the toughness (Pa sqrt(m)), for loads that stay; `low` where there is none.
double longest_overloaded_kink(const Sifs& sifs, double toughness, double low, double high);

/// d ln K_eq / d length (1/m) at the end of such a kink; not finite where K_eq vanishes.
double log_slope_of_kink(const Sifs& sifs, double length);

/// The angle (rad, at most `limit` in size) of the infinitesimal kink that releases most energy, k_1^2 + k_2^2, of
/// those that open, k_1 > 0, and turn away from K_II; 0 where none does. In pure mode II 75.8 degrees by the series of
/// Amestoy and Leblond; K_II vanishes at 77.3, and the tangential stress is largest at 70.5. `resistance`: the
/// toughness for a kink of this angle over that straight ahead; with it, of the kinks to both sides, that with the
/// largest (k_1^2 + k_2^2)/resistance^2.
double largest_release_angle(const Sifs& sifs, double limit = 1.5,
                             const std::function<double(double)>& resistance = {});

}  // namespace sprekk::fine_fracture
