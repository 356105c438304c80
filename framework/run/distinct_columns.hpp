// Columns of history.csv, which have to differ by name.
#pragma once

#include <vector>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// Throws InputError where two quantities of a scene have one name: readers of the table would see one of them only.
void require_distinct_columns(const std::vector<Quantity>& quantities);

}  // namespace sprekk
