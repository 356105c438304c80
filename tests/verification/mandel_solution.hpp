// Mandel's problem in closed form (Cheng and Detournay 1988), for continuous time and for backward Euler.
#pragma once

#include <cmath>
#include <vector>

#include "framework/types.hpp"

namespace sprekk::testing {

/// A quarter a × b of the block; F is the force on the plate over [0, a] (N/m), pressing.
struct Mandel {
  double a = 1, force = 1e7;
  double poisson = 0.2, undrained_poisson, shear, skempton, diffusivity;
  std::vector<double> roots;

  /// The rock of Table 1 of the paper: all from E, nu, alpha, phi, c_p, k, mu.
  Mandel() {
    const double young = 40e9, alpha = 0.8, porosity = 0.01, fluid = 4e-10, mobility = 5e-20 / 1e-4;
    const double bulk = young / (3 * (1 - 2 * poisson));
    shear = young / (2 * (1 + poisson));
    const double storage = porosity * fluid + (alpha - porosity) / bulk;
    const double undrained_bulk = bulk + alpha * alpha / storage;
    skempton = alpha / (storage * undrained_bulk);
    undrained_poisson = (3 * undrained_bulk - 2 * shear) / (2 * (3 * undrained_bulk + shear));
    diffusivity = mobility / (storage + alpha * alpha / (bulk + 4 * shear / 3));
    const double ratio = (1 - poisson) / (undrained_poisson - poisson);
    for (int k = 0; k < 400; ++k) {  // tan A = ratio A, bracketed
      double low = k * M_PI + 1e-9, high = (k + 0.5) * M_PI - 1e-12;
      for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (std::tan(middle) > ratio * middle ? high : low) = middle;
      }
      roots.push_back(0.5 * (low + high));
    }
  }

  /// exp(−A² c t/a²), or for steps > 0 what backward Euler makes of it in so many equal steps.
  double decay(double root, double time, int steps) const {
    const double rate = root * root * diffusivity / (a * a);
    return steps > 0 ? std::pow(1 + rate * time / steps, -steps) : std::exp(-rate * time);
  }

  double pressure(double x, double time, int steps = 0) const {
    double sum = 0;
    for (const double r : roots)
      sum +=
          std::sin(r) / (r - std::sin(r) * std::cos(r)) * (std::cos(r * x / a) - std::cos(r)) * decay(r, time, steps);
    return 2 * force * skempton * (1 + undrained_poisson) / (3 * a) * sum;
  }

  Point displacement(const Point& x, double time, int steps = 0) const {
    double uniform = 0, wave = 0;
    for (const double r : roots) {
      const double weight = decay(r, time, steps) / (r - std::sin(r) * std::cos(r));
      uniform += weight * std::sin(r) * std::cos(r);
      wave += weight * std::cos(r) * std::sin(r * x[0] / a);
    }
    const double unit = force / (shear * a);
    return {(unit * poisson / 2 - unit * undrained_poisson * uniform) * x[0] + force / shear * wave,
            (-unit * (1 - poisson) / 2 + unit * (1 - undrained_poisson) * uniform) * x[1]};
  }
};

}  // namespace sprekk::testing
