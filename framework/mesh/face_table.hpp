// The faces of a mesh before it is split, and the cells on their two sides.
#pragma once

#include <array>
#include <vector>

#include "framework/mesh/shapes.hpp"

namespace sprekk {

/// Numbers the faces (edges in a plane) of cells, and finds their nodes and cells.
class FaceTable {
 public:
  /// Numbers faces in the order in which the cells first name them. The cells are oriented as their shapes are.
  /// Throws InputError where more than two cells meet at a face, two lie on the same side of it, or a cell names a node
  /// that does not exist.
  FaceTable(const std::vector<Point>& nodes, const std::vector<CellNodes>& cells);

  int size() const { return static_cast<int>(nodes_.size()); }
  /// The nodes of a face, as cells(face)[0] has them.
  const FaceNodes& nodes(int face) const { return nodes_[face]; }
  /// The cells on both sides of a face; the second is none on the boundary of the mesh.
  const std::array<int, 2>& cells(int face) const { return cells_[face]; }
  /// The faces of a cell, in the order of its shape.
  const CellFaces& of_cell(int cell) const { return of_cell_[cell]; }
  bool is_outer(int face) const { return cells_[face][1] < 0; }
  /// The face with these nodes, in any order, or none.
  int find(const FaceNodes& nodes) const;

 private:
  void add(const std::vector<Point>& nodes, int cell, int k, const FaceNodes& face);

  std::vector<FaceNodes> nodes_;
  std::vector<std::array<int, 2>> cells_;
  std::vector<CellFaces> of_cell_;
  std::vector<int> first_at_node_;  ///< the newest face whose smallest node this is; next_ links the others
  std::vector<int> next_;
};

}  // namespace sprekk
