// Of which dimension the results of a run are.
#pragma once

#include <filesystem>

namespace sprekk {

/// 3 where run.json of this folder says so, else 2.
int dimension_of_results(const std::filesystem::path& folder);

}  // namespace sprekk
