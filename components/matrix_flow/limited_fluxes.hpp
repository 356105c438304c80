// Two approximations of fluxes, combined so that pressures keep their bounds.
#pragma once

#include "framework/types.hpp"

namespace sprekk::matrix_flow {

/// Two approximations of the same fluxes, combined: their harmonic mean where they have the same sign, and zero
/// elsewhere. One approximation is a sum of differences from the pressure of the one cell at the face, the other from
/// that of the other cell, with coefficients that are not negative. The mean is each of them times a factor from 0 to
/// 2, so it is such a sum for both cells. Its derivatives jump only where one of the two is zero; where both are, the
/// derivatives of the arithmetic mean are taken.
struct LimitedFluxes {
  Vector value;                ///< m^2/s, one a face
  Vector by_first, by_second;  ///< derivatives
};
/// Instead of a `rounding`: the exact function, whose derivatives are replaced by the weights with which it is a mean
/// of a and b, |b|/(|a| + |b|) and |a|/(|a| + |b|). The weights do not jump where a flux changes its sign.
inline constexpr double with_secants = -1;
/// `rounding` (m^2/s) makes the function smooth, for Newton's method alone: with x+ = (x + sqrt(x² + rounding²))/2 it
/// is the harmonic mean of a+ and b+ less that of (−a)+ and (−b)+. With 0 it is exact, with infinity it is (a + b)/2.
LimitedFluxes limit(const Vector& first, const Vector& second, double rounding = 0);

}  // namespace sprekk::matrix_flow
