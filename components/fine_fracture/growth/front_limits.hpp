// Limits and first estimates that the parts of a search for a front have in common.
#pragma once

namespace sprekk::fine_fracture {

inline constexpr double first_slope = -0.3;  ///< of ln K_eq over one increment, as long as none is known
inline constexpr double first_part = 0.25;   ///< of an increment: the first trial of a tip without a known speed
inline constexpr double largest_turn = 0.3;  ///< rad, between two trials
inline constexpr double least_kink = 0.2;    ///< rad: behind a larger one K falls with the length of the wing
inline constexpr double at_limit = 1e-9;     ///< of a length that is at its limit, but for rounding

}  // namespace sprekk::fine_fracture
