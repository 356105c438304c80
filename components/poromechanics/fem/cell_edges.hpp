// The edges of cells in space, which have functions of their own at second order.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// The edges of all cells. In a plane there are none: what joins two corners is a face.
struct CellEdges {
  std::vector<std::array<int, 2>> nodes;  ///< of each edge, the smaller number first
  std::vector<ShortList<12>> of_cell;     ///< in the order of edges_of_shape
  int count() const { return static_cast<int>(nodes.size()); }
};
CellEdges find_edges(const Mesh& mesh);

/// The corners of each edge of the shape with so many corners.
std::span<const std::array<int, 2>> edges_of_shape(int corners);

}  // namespace sprekk::poromechanics
