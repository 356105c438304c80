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

/// Four points: exact for polynomials of the seventh degree.
inline std::array<GaussPoint, 4> four_gauss_points() {
  const double root = std::sqrt(6.0 / 5) * 2 / 7, inner = std::sqrt(3.0 / 7 - root) / 2,
               outer = std::sqrt(3.0 / 7 + root) / 2;
  const double of_inner = (18 + std::sqrt(30.0)) / 72, of_outer = (18 - std::sqrt(30.0)) / 72;
  return {{{0.5 - outer, of_outer}, {0.5 - inner, of_inner}, {0.5 + inner, of_inner}, {0.5 + outer, of_outer}}};
}

}  // namespace sprekk::poromechanics
