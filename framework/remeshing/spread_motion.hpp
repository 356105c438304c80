// Moves nodes of a mesh along with a few that are moved.
#pragma once

#include <array>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// A node that is put to another place.
struct MovedNode {
  int node;
  Point by;  ///< m
};

/// Motions (m) of all nodes: zero for those at rest, given ones for some, and for the others the mean of their
/// neighbours, weighted by one over the distance (of the middle of an edge) to the nearest moved node. In two
/// dimensions this falls about linearly from a moved node to what is at rest around it, which strains the cells between
/// both equally. It is linear in the given motions, and lies in their convex hull with zero. Every node must be
/// connected by edges to one that is moved or at rest; otherwise throws std::runtime_error.
std::vector<Point> spread_motion(const std::vector<Point>& nodes, const std::vector<std::array<int, 2>>& edges,
                                 const std::vector<bool>& is_at_rest, const std::vector<MovedNode>& moved);

}  // namespace sprekk
