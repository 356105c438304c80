// Expressions of place, time and the state as data.
#pragma once

#include <string>

#include "framework/config/input_error.hpp"
#include "framework/config/state.hpp"
#include "framework/config/unit.hpp"

namespace sprekk {

/// The datum `scale` times the expression; a constant one when no variable occurs. Throws InputError when malformed,
/// and when it jumps where a variable of the state changes. `name` is the parameter's, for messages.
Data parse_expression(const std::string& text, double scale, const Origin& where, const std::string& name,
                      const StateVariables& state);

/// What an expression lacks to have a given dimension. `none`: its units give it that dimension, with coordinates as
/// plain numbers or lengths, t as a plain number or a time; or it is zero. `any`: it has no unit at all, and needs one.
/// `of_a_term`: its units do not give that dimension.
enum class LackOfUnit { none, any, of_a_term };
/// What an expression lacks, see LackOfUnit. Numbers without a unit count as lengths where `dimension` is one. The
/// expression is evaluated at a few places, times and states, with units of other sizes. Throws InputError when it is
/// malformed.
LackOfUnit lack_of_unit(const std::string& text, const Dimension& dimension, const Origin& where,
                        const StateVariables& state);

/// "x = 1, y = 2, t = 3" for messages about evaluations, with the state while formulas see one.
std::string place_text(const Place& place);

}  // namespace sprekk
