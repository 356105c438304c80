// How K_II follows the direction of the last segment of a path.
#pragma once

#include "components/fine_fracture/growth/mixed_mode.hpp"

namespace sprekk::fine_fracture {

inline constexpr double short_kink_turn_slope = 0.5;  ///< d(K_II/K_I)/d angle (Cotterell and Rice 1980)

/// d(K_II/K_I)/d angle of a segment of this length (m) that turns about its beginning, by the expansion of a kink:
/// compression along the tip makes the direction of long segments stiffer. A bent segment is an arc that begins in a
/// fixed direction: its end turns twice as much as its chord. `toughness`: K_IC, Pa sqrt(m).
double turn_slope(const Sifs& sifs, double toughness, double length, bool is_bent);

}  // namespace sprekk::fine_fracture
