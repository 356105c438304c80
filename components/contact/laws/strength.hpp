// Friction, cohesion and tensile strength, and how walls lose them.
#pragma once

#include <algorithm>

#include "framework/config/data.hpp"
#include "framework/config/spec.hpp"

namespace sprekk::contact {

/// The strength of walls at a path q (m): |f_t| <= cohesion − friction f_n, f_n <= tension (Pa), and its derivatives by
/// q.
struct Strength {
  double friction, cohesion = 0, tension = 0;
  double friction_by_path = 0, cohesion_by_path = 0, tension_by_path = 0;
  /// Where friction and cohesion are formulas: by the size of the slip, the slip rate and the pressure between the
  /// walls.
  double friction_by_slip = 0, cohesion_by_slip = 0, friction_by_rate = 0, cohesion_by_rate = 0;
  double friction_by_pressure = 0, cohesion_by_pressure = 0;
};

/// The loss of strength over slip, Pa/m, under this normal traction (Pa), in a step of length dt (s).
inline double lost_by_slip(const Strength& s, double normal, double dt) {
  double lost = s.friction_by_path * normal - s.cohesion_by_path;
  lost += s.friction_by_slip * normal - s.cohesion_by_slip;
  return dt > 0 ? lost + (s.friction_by_rate * normal - s.cohesion_by_rate) / dt : lost;
}

/// Linear weakening: with m = min(1, q/D) friction is mu_s − m (mu_s − mu_d), cohesion and tensile strength are 1 − m
/// of their values at the start (for friction: Ida, J. Geophys. Res. 77 (1972) 3796; Andrews, J. Geophys. Res. 81
/// (1976) 3575). The path q counts all slip, forth and back, and all opening: what is lost does not come back. Without
/// a distance nothing is lost (Mohr-Coulomb).
struct Weakening {
  double distance = 0;          ///< D, m; 0 without weakening
  double cohesion = 0;          ///< Pa
  double tensile_strength = 0;  ///< Pa

  bool is_on() const { return distance > 0; }
  Strength at(double static_friction, double dynamic_friction, double path) const {
    Strength s{static_friction, cohesion, tensile_strength};
    if (!is_on()) return s;
    const double lost = std::min(1.0, path / distance), rate = path < distance ? 1 / distance : 0.0;
    // A friction that is below mu_d from the start stays as it is.
    const double drop = std::max(0.0, static_friction - dynamic_friction);
    s.friction -= lost * drop;
    s.friction_by_path = -rate * drop;
    s.cohesion = (1 - lost) * cohesion;
    s.cohesion_by_path = -rate * cohesion;
    s.tension = (1 - lost) * tensile_strength;
    s.tension_by_path = -rate * tensile_strength;
    return s;
  }
};

}  // namespace sprekk::contact
