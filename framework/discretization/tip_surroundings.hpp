// Which nodes are tips of fractures, and how far around them nothing else is.
#pragma once

#include <array>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// The fracture cells whose walls are the faces with one cell at a node: {none, none} in the rock.
struct NodeWalls {
  std::array<int, 2> cells{none, none};
  bool are_all = true;  ///< of these faces: not on a side, nor where fractures meet

  NodeWalls(const Mesh& mesh, int node);
};

/// Whether both faces with one cell are walls of the same fracture cell, which ends there.
bool is_tip(const Mesh& mesh, int node);

/// Whether the field of a tip, the end of the given fracture cell, goes on at a node: not on sides, on other
/// fractures, on the tip's own beyond a kink (10 degrees), nor where a single cell is.
bool tip_field_goes_on(const Mesh& mesh, int node, const FractureCell& last);

/// The nodes that are within so many edges from a tip, with itself, along nodes where its field goes on.
std::vector<int> nodes_around_tip(const Mesh& mesh, int tip, int edges);

}  // namespace sprekk
