// Columns of history.csv, which have to differ by name.
#pragma once

#include <vector>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// Throws InputError where two quantities of a scene have one name, so that whoever reads the table sees one of them.
void require_distinct_columns(const std::vector<Quantity>& quantities);

}  // namespace sprekk
