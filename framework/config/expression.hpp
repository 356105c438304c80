// Expressions of x, y and t.
#pragma once

#include <string>

#include "framework/config/data.hpp"
#include "framework/config/input_error.hpp"

namespace sprekk {

/// The datum `scale` times the expression; a constant one when no variable occurs. Throws InputError when malformed.
Data parse_expression(const std::string& text, double scale, const Origin& where);

/// "x = 1, y = 2, t = 3" for messages about evaluations.
std::string place_text(const Place& place);

}  // namespace sprekk
