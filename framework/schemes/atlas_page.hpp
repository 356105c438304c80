// The atlas as one page.
#pragma once

#include <string>
#include <vector>

#include "framework/schemes/scheme_result.hpp"

namespace sprekk {

/// HTML that loads no other file: what is cheapest, the table, a picture of each split, and the maps.
std::string atlas_page(const std::string& scene, const std::vector<SchemeResult>& results,
                       const std::vector<AtlasMap>& maps);

}  // namespace sprekk
