// The dimension of a scene. Each program is for one dimension; a scene of the other one is handed over to the other
// program.
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
