// Moves nodes of a mesh along with a few that are displaced.
#pragma once

#include <array>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// A node that is put to another place.
struct DisplacedNode {
  int node;
  Point by;  ///< m
};

/// Displacements (m) of all nodes: zero for those at rest, given ones for some, and for the others the mean of their
/// neighbours, weighted by one over the distance (of the middle of an edge) to the nearest displaced node. In two
/// dimensions this falls about linearly from a displaced node to what is at rest around it, which strains the cells
/// between both equally. It is linear in the given displacements, and lies in their convex hull with zero. Every node
/// must be connected by edges to one that is displaced or at rest; otherwise throws std::runtime_error.
std::vector<Point> spread_displacement(const std::vector<Point>& nodes, const std::vector<std::array<int, 2>>& edges,
                                       const std::vector<bool>& is_at_rest,
                                       const std::vector<DisplacedNode>& displaced);

}  // namespace sprekk
