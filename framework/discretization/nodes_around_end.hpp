// Which nodes are ends of fractures, and which nodes around an end its singular field reaches undisturbed.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Whether a node is an end of a fracture in the rock around which its field is that of a straight end. In a plane:
/// both faces with one cell are walls of the same fracture cell, which ends at the node. In space: a node of a rim
/// (rim_at) that bends by at most 45 degrees there, and meets sides at right angles.
bool is_fracture_end(const Mesh& mesh, int node);

/// The nodes within `edges` edges of an end, the end among them, along nodes where its field is undisturbed: not on
/// sides (but in space on those that the rim meets at right angles), not on other fractures, not on the end's own
/// fracture beyond a kink (10 degrees), and not where the node has one cell.
std::vector<int> nodes_around_end(const Mesh& mesh, int end, int edges);

}  // namespace sprekk
