// The factor that a written unit stands for.
#pragma once

#include <string>

#include "framework/config/input_error.hpp"
#include "framework/config/unit.hpp"

namespace sprekk {

/// `written` in SI units, when it has the dimension of `unit`; else InputError about `whole`, the text that it is in.
double scale_to_si(const std::string& written, const std::string& unit, const std::string& whole, const Origin& where,
                   const std::string& name);

}  // namespace sprekk
