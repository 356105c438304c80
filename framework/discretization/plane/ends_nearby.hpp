// Which nodes are so near to the end of a fracture that its singular fields dominate.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// How far around an end its field counts. Only tests take other values, to see how much answers depend on them.
struct EndLimits {
  /// Edges from the end to where linear functions suffice: their error falls with the square of the distance.
  int layers = 3;
  /// Of the distance to the next end. Halfway between two ends both fields are as strong, and a symmetric mesh must
  /// have a symmetric result: neither end is taken.
  double clearly = 0.9;
};

/// For every node: the end (a node, see is_fracture_end) that the node is or that lies within `layers` edges of it, or
/// none. The result is none for nodes on sides, on other fractures, on the end's own fracture beyond a kink (10
/// degrees), with one cell, and about halfway between two ends.
std::vector<int> ends_nearby(const Mesh& mesh, const EndLimits& limits = {});

}  // namespace sprekk
