// Domains and comparisons that the tests of boundary elements share.
#pragma once

#include <gtest/gtest.h>

#include "components/fine_fracture/boundary_element/boundary_model.hpp"
#include "tests/components/fine_fracture/quarter_point/cases.hpp"

namespace sprekk::test {

/// A rotation by an angle (rad), or a mirror image.
inline Tensor turn_by(double angle, bool is_mirrored = false) {
  Tensor turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  if (is_mirrored) turn.col(1) *= -1;
  return turn;
}

/// The factors of a tip with elements of `largest` (m) there.
inline TipFactors boundary_factors(const FineGeometry& geometry, const Elasticity& rock, const TipPlace& tip,
                                   const FineLoads& loads, double largest, double spacing = 0) {
  return BoundaryModel(geometry, {.sizes = {.largest = largest}, .spacing = spacing}, rock, tip).solve(loads);
}

inline Point intensities_of(const TipFactors& factors) { return {factors.sifs.k1, factors.sifs.k2}; }

}  // namespace sprekk::test
