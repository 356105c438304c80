// Stress intensity factors from the displacement jumps behind a tip.
#pragma once

#include <vector>

#include "components/fine_fracture/growth/mixed_mode.hpp"

namespace sprekk::fine_fracture {

/// The jump of a place behind a tip, in the frame of the tip (mixed_mode.hpp), m.
struct JumpBehind {
  double distance;  ///< m, to the tip along the fracture
  double opening;   ///< along x2: of the wall at x2 > 0 against the other
  double slip;      ///< along x1, of the same
};

/// Factors, and how much they change with one place less, Pa sqrt(m); not a number where there is only one place.
struct FittedFactors {
  Sifs sifs;  ///< its T-stress is unknown: 0
  double error;
};

/// By the expansion of Williams (J. Appl. Mech. 24 (1957) 109) the jumps at the distance r are
///   8/E' sqrt(r/(2 pi)) (K + c r + …),
/// so K is where the straight line through E'/8 sqrt(2 pi/r) [u] over r (least squares) meets the tip (Chan, Tuba and
/// Wilson, Engrg. Fract. Mech. 2 (1970) 1). Where the other end of the fracture, at r = L, is a tip too, the jumps of a
/// straight one are sqrt(r (1 − r/L)) times a function as smooth as the tractions, and a constant where these are
/// constant (Muskhelishvili 1953; Erdogan and Gupta, Quart. Appl. Math. 29 (1972) 525): the line then goes through
/// E'/8 sqrt(2 pi/r) [u]/sqrt(1 − r/L), which has the same limit. `jumps`: one or more, the nearest first;
/// `plane_modulus`: E', Pa; `to_other_tip`: L, m, or infinity.
FittedFactors factors_from_jumps(const std::vector<JumpBehind>& jumps, double plane_modulus, double to_other_tip);

}  // namespace sprekk::fine_fracture
