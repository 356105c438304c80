// Section 5.1 of the paper in closed form: a slipping crack with poroelastic back stress.
#pragma once

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {

/// What the closed form says of the slipping fracture at fluid pressure p_f while it injects into the rock.
struct OnsetCrack {
  double normal, shear;  ///< tractions of the contact, Pa, normal negative
  double peak_slip;      ///< at the centre, m
  double k2;             ///< K_II, Pa sqrt(m)
};

/// Delta N = eta (p_f - p_mean - A/2), A = Q mu/(2 pi k): superposition of the irrotational Biot field of a line source
/// of uniform pressure and of the free boundary. Q is the flux into the rock, p_mean the mean pressure of the box.
inline OnsetCrack onset_crack(const SceneRun& run) {
  constexpr double half_length = 0.05, friction = 0.5, dilation = M_PI / 180, plane_modulus = 40e9 / (1 - 0.04);
  double flux = 0, mean = 0;
  for (int w = 0; w < run.mesh().wall_count(); ++w)
    flux += run.field("pore.wall_flux")[w] * run.mesh().face_measure[run.mesh().wall_face(w)];
  for (int c = 0; c < run.mesh().cell_count(); ++c)
    mean += run.mesh().cell_measure[c] * run.field("pore.pressure")[c] / 4;
  const double fluid = run.quantity("fracture_pressure"), source = flux * 1e-4 / (2 * M_PI * 5e-20);
  const double back_stress = 0.30 * (fluid - mean - 0.5 * source);
  const double total_normal = 15e6 + back_stress, shear = 5e6;
  const double drop = (shear - friction * (total_normal - fluid)) / (1 + friction * std::tan(dilation));
  // Slip opens the crack by dilation, which adds D tan(psi) to the compression.
  const double normal = total_normal - fluid + drop * std::tan(dilation);
  return {-normal, friction * normal, 4 / plane_modulus * drop * half_length, drop * std::sqrt(M_PI * half_length)};
}

}  // namespace sprekk::testing
