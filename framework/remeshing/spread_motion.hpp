// Moves nodes of a mesh along with a few that are moved.
#pragma once

#include <array>
#include <memory>
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
/// both equally. It is linear in the given motions, and lies in their convex hull with zero. The equations are
/// factorized once for all motions of the same nodes.
class SpreadMotion {
 public:
  /// `moved`: the nodes whose motions are given. Every node must be connected by edges to one that is moved or at rest;
  /// otherwise throws std::runtime_error.
  SpreadMotion(const std::vector<Point>& nodes, const std::vector<std::array<int, 2>>& edges,
               const std::vector<bool>& is_at_rest, const std::vector<int>& moved);
  ~SpreadMotion();
  SpreadMotion(const SpreadMotion&) = delete;
  SpreadMotion& operator=(const SpreadMotion&) = delete;
  /// The motions of all nodes; `moved`: those of the moved nodes.
  std::vector<Point> of(const std::vector<MovedNode>& moved) const;

 private:
  struct Equations;
  std::vector<char> is_moved_;  ///< by node
  std::vector<int> unknown_;    ///< by node: its number, or none
  std::unique_ptr<const Equations> equations_;
};

/// The same for one motion.
std::vector<Point> spread_motion(const std::vector<Point>& nodes, const std::vector<std::array<int, 2>>& edges,
                                 const std::vector<bool>& is_at_rest, const std::vector<MovedNode>& moved);

}  // namespace sprekk
