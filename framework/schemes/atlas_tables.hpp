// The results of an atlas as tables.
#pragma once

#include <string>
#include <vector>

#include "framework/schemes/scheme_result.hpp"

namespace sprekk {

/// The scheme that converges with the fewest seconds of the processor; nullptr if none does. `split`: of those that are
/// not monolithic.
const SchemeResult* cheapest(const std::vector<SchemeResult>& results, bool split);

/// A head and a row for each scheme: for the terminal and the page.
std::vector<std::vector<std::string>> result_rows(const std::vector<SchemeResult>& results);
/// A row for each run, with numbers; empty where there is none.
std::string atlas_csv(const std::vector<SchemeResult>& results, const std::vector<AtlasMap>& maps);
std::string atlas_json(const std::vector<SchemeResult>& results, const std::vector<AtlasMap>& maps);

}  // namespace sprekk
