// The fluid that a fracture cell stores in a step, as a function of apertures and pressures at the start and end of the
// step.
#pragma once

#include <cmath>

namespace sprekk::fracture_flow {

/// B(x) = x/(e^x − 1) and its derivative, for any x.
struct Bernoulli {
  double value, derivative;
  explicit Bernoulli(double x) {
    constexpr double small = 1e-2;  // the terms that the series leave out are below 1e-16 and 1e-13
    if (std::abs(x) < small) {
      value = 1 - x / 2 + x * x / 12 - x * x * x * x / 720;
      derivative = -0.5 + x / 6 - x * x * x / 180;
      return;
    }
    value = x / std::expm1(x);
    derivative = value * (1 + x / std::expm1(-x)) / x;  // B(−x) = −x/(e^−x − 1)
  }
};

/// The density of the fluid that enters: the mean one of the step, or that at its end, as in a stage of a scheme of
/// second order (HeedsStages).
enum class EnteringDensity { of_step, at_end };

/// The volume that a cell stores in a step over its length, in space over its area (m), and its derivatives.
struct StoredFluid {
  double volume, by_aperture, by_pressure;
};

/// A cell holds the mass rho(p) a, with rho proportional to exp(c p). The volume that enters, at the pressure of the
/// cell, is the change of this mass over the mean density of the step:
///   (rho_1 a_1 − rho_0 a_0)/rho_mean = (a_1 − a_0) b + e a_1,   e = c (p_1 − p_0),
/// with b = B(e) for the logarithmic mean of both densities. So the mass depends on the state alone: if nothing enters,
/// rho a is constant to round-off, however the cell opens and closes and in however many steps. Only differences of
/// pressure count, so a change of the compressibility stores nothing.
///
/// Where aperture and pressure rise or fall together, the fluid moves the walls, and both change in proportion: then
/// the mean density along this line, b = 1 − e/2, makes a step exact for walls that respond linearly. Both values of b
/// differ by terms of second order in e only. `before`, `after`: the apertures a_0 and a_1, m; `change`: p_1 − p_0, Pa.
inline StoredFluid stored_fluid(double before, double after, double change, double compressibility,
                                EnteringDensity density) {
  const double opening = after - before, e = compressibility * change;
  double b = 1, by_e = 0;
  if (density == EnteringDensity::of_step) {
    if (opening * e > 0) {
      b = 1 - e / 2;
      by_e = -0.5;
    } else {
      const Bernoulli of_e(e);
      b = of_e.value;
      by_e = of_e.derivative;
    }
  }
  return {opening * b + e * after, b + e, compressibility * (opening * by_e + after)};
}

}  // namespace sprekk::fracture_flow
