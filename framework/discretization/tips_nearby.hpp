// Which nodes are so near to the tip of a fracture that its singular fields dominate.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// For every node: the tip (a node, see is_tip) that the node is or that lies within three edges of it, or none. The
/// result is none for nodes on sides, on other fractures, on the tip's own fracture beyond a kink (10 degrees), with
/// one cell, and about halfway between two tips.
std::vector<int> tips_nearby(const Mesh& mesh);

}  // namespace sprekk
