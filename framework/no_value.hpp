// What stands where there is no number.
#pragma once

#include <limits>

namespace sprekk {

/// In a table, an empty cell; in a curve, a gap; in a field, a place where a quantity is not known.
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

}  // namespace sprekk
