// The edges of a triangulation and the triangles on their two sides.
#pragma once

#include <array>
#include <vector>

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

class TriangleEdges {
 public:
  /// Numbers edges in the order in which the triangles first name them. The triangles are counter-clockwise.
  /// Throws InputError where more than two triangles meet at an edge, two lie on the same side of it, or a triangle
  /// names a node that does not exist.
  explicit TriangleEdges(const std::vector<Point>& nodes, const std::vector<std::array<int, 3>>& triangles);

  int size() const { return static_cast<int>(nodes_.size()); }
  /// From first to second, counter-clockwise in triangles(edge)[0].
  const std::array<int, 2>& nodes(int edge) const { return nodes_[edge]; }
  /// [1] is none on the boundary of the triangulation.
  const std::array<int, 2>& triangles(int edge) const { return triangles_[edge]; }
  /// Edge k of a triangle joins its nodes k and k+1 (mod 3).
  const std::array<int, 3>& of_triangle(int triangle) const { return of_triangle_[triangle]; }
  bool is_outer(int edge) const { return triangles_[edge][1] < 0; }
  /// The edge that joins two nodes, in either order, or none.
  int find(int a, int b) const;

 private:
  std::vector<std::array<int, 2>> nodes_, triangles_;
  std::vector<std::array<int, 3>> of_triangle_;
  std::vector<int> first_at_node_;  ///< the newest edge whose smaller node this is; next_ links the others
  std::vector<int> next_;
};

}  // namespace sprekk
