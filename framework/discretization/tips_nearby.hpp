// Which nodes feel the singular fields at the tip of a fracture.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// For every node the tip that it is or has within three edges, as a node; or none. A tip: both faces with one cell are
/// walls of the same fracture cell, which ends there. None for nodes on sides, on other fractures, on the tip's own
/// beyond a kink (10 degrees), where a single cell is, and about halfway between two tips.
std::vector<int> tips_nearby(const Mesh& mesh);

}  // namespace sprekk
