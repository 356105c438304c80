// Expressions of x, y and t.
#pragma once

#include <string>

#include "framework/config/data.hpp"
#include "framework/config/input_error.hpp"
#include "framework/config/unit.hpp"

namespace sprekk {

/// The datum `scale` times the expression; a constant one when no variable occurs. Throws InputError when malformed.
Data parse_expression(const std::string& text, double scale, const Origin& where);

/// Whether a constant expression without a unit behind it lacks a unit, for a quantity of a given dimension. `none`:
/// the units in the expression give it that dimension, or it is zero. `any`: the expression has no unit at all.
/// `of_a_term`: the units in it do not give that dimension. An expression of x, y or t lacks nothing: x, y and t are in
/// SI units, and so is their result.
enum class LackOfUnit { none, any, of_a_term };
/// What an expression lacks, see LackOfUnit. Throws InputError when the expression is malformed.
LackOfUnit lack_of_unit(const std::string& text, const Dimension& dimension, const Origin& where);

/// "x = 1, y = 2, t = 3" for messages about evaluations.
std::string place_text(const Place& place);

}  // namespace sprekk
