// Which nodes are so near to the end of a fracture that its singular fields dominate.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// For every node: the end (a node, see is_fracture_end) that the node is or that lies within three edges of it, or
/// none. The result is none for nodes on sides, on other fractures, on the end's own fracture beyond a kink (10
/// degrees), with one cell, and about halfway between two ends.
std::vector<int> ends_nearby(const Mesh& mesh);

}  // namespace sprekk
