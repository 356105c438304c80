// The edges of cells in space that have functions of their own.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// Which edges have functions: all at second order; at first order those that end at the rim of a fracture.
enum class EdgesWithFunctions { all, at_rims };

/// The edges of all cells that have functions. In a plane there are none: what joins two corners is a face.
///
/// The middle node of an edge with one end at the rim of a fracture lies a quarter of the edge away from there: along
/// rays from the rim displacements then have a part like the square root of the distance (Barsoum 1976).
struct CellEdges {
  std::vector<std::array<int, 2>> nodes;  ///< of each edge, the smaller number first
  std::vector<ShortList<12>> of_cell;     ///< in the order of edges_of_shape; none for those without a function
  std::vector<char> is_at_rim;            ///< of each node: whether the rim of a fracture passes through it
  int count() const { return static_cast<int>(nodes.size()); }
  bool are_in(int cell) const;
  /// From the middle of an edge to its middle node, m.
  Point shift(const Mesh& mesh, int edge) const;
};
CellEdges find_edges(const Mesh& mesh, EdgesWithFunctions which);

/// The corners of each edge of the shape with so many corners.
std::span<const std::array<int, 2>> edges_of_shape(int corners);

}  // namespace sprekk::poromechanics
