// Points and weights of integrals over cells and faces.
#pragma once

#include <array>
#include <cmath>

namespace sprekk::poromechanics {

/// A point of the interval from 0 to 1, and its weight.
struct GaussPoint {
  double at, weight;
};

/// Gauss-Legendre's three points: exact for polynomials of the fifth degree.
inline std::array<GaussPoint, 3> gauss_points() {
  const double offset = std::sqrt(3.0 / 5) / 2;
  return {{{0.5 - offset, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + offset, 5.0 / 18}}};
}

}  // namespace sprekk::poromechanics
