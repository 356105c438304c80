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

/// For every node: the end (a node, see is_fracture_end) that the node is or that lies within `layers` edges of it
/// (nodes_around_end), or none. The result is none about halfway between two ends, in space between two rims, and where
/// a node of a rim that is no end (a corner) is nearer.
std::vector<int> ends_nearby(const Mesh& mesh, const EndLimits& limits = {});

/// The end whose field counts in a whole cell, by ends_nearby of its corners: none where a corner has none. In a plane
/// that of all of them, in space the nearest one, of corners that belong to one rim.
int end_of_cell(const Mesh& mesh, int cell, const std::vector<int>& ends);

}  // namespace sprekk
