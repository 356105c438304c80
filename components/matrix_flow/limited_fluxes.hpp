// Fluxes that are combined of two approximations so that they keep bounds.
#pragma once

#include "framework/types.hpp"

namespace sprekk::matrix_flow {

/// Two approximations of the same fluxes, combined: their harmonic mean where they have the same sign, and zero
/// elsewhere. If each approximation is a sum of differences from the pressure of one of the two cells at the face, with
/// coefficients that are not negative, so is the mean: it is each of them times a factor from 0 to 2. Its derivatives
/// jump only where one of the two is zero; where both are, those of the arithmetic mean are taken.
struct LimitedFluxes {
  Vector value;                ///< m^2/s, one a face
  Vector by_first, by_second;  ///< derivatives
};
/// Instead of a `rounding`: the exact function, and in place of its derivatives the weights with which it is a mean of
/// a and b, |b|/(|a| + |b|) and |a|/(|a| + |b|). These do not jump where a flux changes its sign.
inline constexpr double with_secants = -1;
/// `rounding` (m^2/s) makes the function smooth, for Newton's method alone: with x+ = (x + sqrt(x² + rounding²))/2 it
/// is the harmonic mean of a+ and b+ less that of (−a)+ and (−b)+. With 0 it is exact, with infinity it is (a + b)/2.
LimitedFluxes limit(const Vector& first, const Vector& second, double rounding = 0);

}  // namespace sprekk::matrix_flow
