// Expressions of x, y and t.
#pragma once

#include <string>

#include "framework/config/data.hpp"
#include "framework/config/input_error.hpp"
#include "framework/config/unit.hpp"

namespace sprekk {

/// The datum `scale` times the expression; a constant one when no variable occurs. Throws InputError when malformed.
Data parse_expression(const std::string& text, double scale, const Origin& where);

/// What a constant expression without a unit behind it lacks, for a quantity of this dimension. none: it has the
/// dimension, since it changes like it with the units that it is made of, or it is zero. An expression of x, y or t
/// lacks nothing: x, y and t are in SI units, and so is what is made of them.
enum class LackOfUnit { none, any, of_a_term };
/// Throws InputError when malformed.
LackOfUnit lack_of_unit(const std::string& text, const Dimension& dimension, const Origin& where);

/// "x = 1, y = 2, t = 3" for messages about evaluations.
std::string place_text(const Place& place);

}  // namespace sprekk
