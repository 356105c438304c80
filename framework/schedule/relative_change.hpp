// The change of fields over a step.
#pragma once

#include <vector>

#include "framework/field/field.hpp"

namespace sprekk {

/// The largest difference of current and accepted values over the largest value of either. Fields of one unit share a
/// scale, as displacements and jumps do.
double relative_change(const std::vector<const Field*>& fields);

}  // namespace sprekk
