// Units of amounts: in a plane those of a slice that is one metre thick.
#pragma once

#include "framework/types.hpp"

namespace sprekk {

inline constexpr const char* volume_unit = dimension == 2 ? "m^2" : "m^3";
inline constexpr const char* volume_rate_unit = dimension == 2 ? "m^2/s" : "m^3/s";
inline constexpr const char* energy_unit = dimension == 2 ? "J/m" : "J";

}  // namespace sprekk
