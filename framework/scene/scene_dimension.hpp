// Of which dimension a scene is. Each program is for one; a scene of another one is handed over to the program for it.
#pragma once

#include <string>

#include "framework/config/node.hpp"
#include "framework/config/other_dimension.hpp"

namespace sprekk {

/// 3 for a scene whose box has a z or whose mesh file (relative to `folder`) has volumes, else 2; wrong input counts as
/// 2.
int dimension_of(const Node& scene, const std::string& folder);

/// Throws OtherDimension.
void require_dimension(const Node& scene, const std::string& folder);

}  // namespace sprekk
