// A run as one self-contained HTML page: curves, fields, convergence, timing.
#pragma once

#include <filesystem>
#include <string>

#include "framework/report/run_results.hpp"

namespace sprekk {

/// The page as HTML. Pictures, styles and scripts are inside; it loads no other file.
std::string report_page(const RunResults& results);

/// Writes folder/report.html and returns its path. Throws InputError if the folder holds no results.
std::filesystem::path write_report(const std::filesystem::path& folder);

}  // namespace sprekk
