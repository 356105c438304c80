// The comparison of runs as one HTML page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/compare/run_difference.hpp"

namespace sprekk {

/// Tables of all differences, curves of all runs against time and their paths. Loads no other file.
std::string difference_page(const std::vector<ComparedRun>& runs, const std::vector<RunDifference>& differences,
                            std::optional<double> tolerance);

}  // namespace sprekk
