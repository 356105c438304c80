// The edges of a plane mesh and the cells on their two sides.
#pragma once

#include <array>
#include <vector>

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Numbers the edges of a plane mesh, and finds their nodes and cells.
class CellEdges {
 public:
  /// Numbers edges in the order in which the cells first name them. The cells are counter-clockwise.
  /// Throws InputError where more than two cells meet at an edge, two lie on the same side of it, or a cell names a
  /// node that does not exist.
  CellEdges(const std::vector<Point>& nodes, const std::vector<Ring>& cells);

  int size() const { return static_cast<int>(nodes_.size()); }
  /// The nodes of an edge; from the first to the second, the edge runs counter-clockwise around cells(edge)[0].
  const std::array<int, 2>& nodes(int edge) const { return nodes_[edge]; }
  /// The cells on both sides of an edge; the second is none on the boundary of the mesh.
  const std::array<int, 2>& cells(int edge) const { return cells_[edge]; }
  /// Edge k of a cell joins its node k and the one after it.
  const Ring& of_cell(int cell) const { return of_cell_[cell]; }
  bool is_outer(int edge) const { return cells_[edge][1] < 0; }
  /// The edge that joins two nodes, in either order, or none.
  int find(int a, int b) const;

 private:
  std::vector<std::array<int, 2>> nodes_, cells_;
  std::vector<Ring> of_cell_;
  std::vector<int> first_at_node_;  ///< the newest edge whose smaller node this is; next_ links the others
  std::vector<int> next_;
};

}  // namespace sprekk
