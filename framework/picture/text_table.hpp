// Tables on a terminal.
#pragma once

#include <string>
#include <vector>

namespace sprekk {

/// Rows of cells in aligned columns: the first to the left, the others to the right.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace sprekk
