// The factor from a written unit to SI units.
#pragma once

#include <string>

#include "framework/config/input_error.hpp"
#include "framework/config/unit.hpp"

namespace sprekk {

/// The factor from the unit `written` to SI units. Throws InputError, which quotes the text `whole`, when `written` has
/// not the dimension of `unit`.
double scale_to_si(const std::string& written, const std::string& unit, const std::string& whole, const Origin& where,
                   const std::string& name);

}  // namespace sprekk
