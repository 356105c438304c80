// The texts on a parameter in `explain` and in the reference pages.
#pragma once

#include <string>

#include "framework/config/spec.hpp"

namespace sprekk {

std::string facts(const Parameter& parameter);         ///< "quantity in Pa, > 0, required"
std::string kind_text(const Parameter& parameter);     ///< "quantity", "one of a, b"
std::string default_text(const Parameter& parameter);  ///< "required", "1000 kg/m^3", "none"
std::string meaning(const Parameter& parameter);       ///< the sentence and its source

/// What `sprekk explain` prints of one parameter.
std::string explain(const Parameter& parameter);

}  // namespace sprekk
