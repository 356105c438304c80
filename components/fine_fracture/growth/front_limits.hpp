// Limits and first estimates that the parts of a search for a front have in common.
#pragma once

namespace sprekk::fine_fracture {

/// Slope of ln K_eq over one increment, as long as the search knows no other: that of wings in the paper's section 5.2.
inline constexpr double first_slope = -0.3;
inline constexpr double first_part = 0.25;   ///< first trial of a tip without a known speed, over the increment
inline constexpr double largest_turn = 0.3;  ///< rad, largest change of a direction between two trials
inline constexpr double least_kink = 0.2;    ///< rad: behind a larger one K falls with the length of the wing
inline constexpr double by_size = 0.5;  ///< power of the length of a fracture with which the effect of an advance falls
inline constexpr double longest_part = 0.35;  ///< of the length of a segment without a direction: what is tried next
inline constexpr double at_limit = 1e-9;      ///< relative distance below which a length counts as being at its limit

}  // namespace sprekk::fine_fracture
