// Differences of runs as tables, for the terminal and for pages.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/compare/run_difference.hpp"

namespace sprekk {

/// Rows of texts, the first of them headings.
using TextRows = std::vector<std::vector<std::string>>;

TextRows history_rows(const RunDifference& difference);  ///< the largest first
TextRows field_rows(const RunDifference& difference);    ///< the largest first
TextRows path_rows(const RunDifference& difference);
TextRows cost_rows(const std::vector<ComparedRun>& runs);

/// "all 24 differences are within 1e-06", or which are beyond it and by how much.
std::string verdict(const RunDifference& difference, double tolerance);
bool is_within(const RunDifference& difference, double tolerance);

/// All of it for the terminal. Of long tables the largest differences are shown.
std::string difference_text(const std::vector<ComparedRun>& runs, const std::vector<RunDifference>& differences,
                            std::optional<double> tolerance);

}  // namespace sprekk
