// Expressions of place, time and the state as data.
#pragma once

#include <optional>
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

/// The dimension that the units of an expression give it (as lack_of_unit understands places and times); none where its
/// terms have different ones. Throws InputError when it is malformed.
std::optional<Dimension> dimension_of(const std::string& text, const Origin& where, const StateVariables& state);
/// The SI unit of a dimension: a name of its own, or a product of powers.
std::string si_unit(const Dimension& dimension);
/// The SI unit of such an expression as data may be written (parse_data); also of a number with a unit. Throws
/// InputError where its terms have different units. `name`: of the parameter, for messages.
std::string unit_of_data(const std::string& text, const Origin& where, const std::string& name,
                         const StateVariables& state);
/// Whether a name stands in the text of an expression.
bool names(const std::string& text, const std::string& name);
/// Whether a name means nothing in an expression yet.
bool is_free_name(const std::string& name, const StateVariables& state);

/// "x = 1, y = 2, t = 3" for messages about evaluations, with the state while formulas see one.
std::string place_text(const Place& place);

}  // namespace sprekk
