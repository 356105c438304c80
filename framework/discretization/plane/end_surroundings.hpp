// What lies at the nodes around the end of a fracture.
#pragma once

#include <array>

#include "framework/discretization/nodes_around_end.hpp"

namespace sprekk {

/// The fracture cells whose walls are the faces with one cell at a node: {none, none} in the rock.
struct NodeWalls {
  std::array<int, 2> cells{none, none};
  bool are_all = true;  ///< whether all faces with one cell are walls of these: not on a side, nor where fractures meet

  NodeWalls(const Mesh& mesh, int node);
};

/// Whether the singular field of an end, the end of the given fracture cell, is undisturbed at a node: not on sides,
/// not on other fractures, not on the end's own fracture beyond a kink (10 degrees), and not where the node has one
/// cell.
bool is_field_undisturbed(const Mesh& mesh, int node, const FractureCell& last);

}  // namespace sprekk
