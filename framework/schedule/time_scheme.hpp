// How a time step is taken: with one stage (backward Euler) or with two. Each part writes one stage; SubcycleStep makes
// two stages of a step.
#pragma once

#include <numbers>

namespace sprekk {

/// The schemes in time. Both are stiffly accurate and damp what a step cannot resolve (L-stable).
enum class TimeScheme {
  backward_euler,  ///< first order
  sdirk2           ///< second order, two stages
};

/// The singly diagonally implicit Runge-Kutta scheme of two stages and second order (Alexander 1977, SIAM J. Numer.
/// Anal. 14, 1006). The first stage is a step of backward Euler over this share of the time step. The second one has
/// the same length and ends with the step. It starts from what the first one has changed, extrapolated by
/// `sdirk2_extrapolation`.
constexpr double sdirk2_share = 1 - std::numbers::sqrt2 / 2;
constexpr double sdirk2_extrapolation = (1 - sdirk2_share) / sdirk2_share;

}  // namespace sprekk
