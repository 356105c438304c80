// What rounding takes numbers apart by, in the few sizes that all of the program compares with. Each is a part of
// something of the same unit, which stands beside it where it is used.
#pragma once

#include <limits>

namespace sprekk::rounding {

/// Of summed terms, of the largest of them: what is left of a sum that ought to be zero.
inline constexpr double of_sum = 64 * std::numeric_limits<double>::epsilon();
/// The same after a chain of operations: some hundred roundings.
inline constexpr double of_terms = 1e-13;
/// Of numbers that ought to be equal, but are given, or found in different ways: coordinates, of an edge or an extent;
/// times, of a step; directions, in rad or as sine or cosine.
inline constexpr double same = 1e-9;
/// Half of all digits (the square root of round-off), where a small number decides how another one is treated.
inline constexpr double half_of_digits = 1e-8;
/// Far above round-off, and far below what a figure shows.
inline constexpr double far_above = 1e-6;
/// Of anything: no division by zero.
inline constexpr double above_zero = 1e-300;

}  // namespace sprekk::rounding
