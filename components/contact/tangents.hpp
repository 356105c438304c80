// How many directions along a fracture there are.
#pragma once

#include "framework/types.hpp"

namespace sprekk {

inline constexpr int tangents = dimension - 1;  ///< of a fracture cell: components of its slip

}  // namespace sprekk
