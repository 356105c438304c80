#include "framework/mesh/triangle_edges.hpp"

#include <algorithm>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/planar.hpp"

namespace sprekk {

TriangleEdges::TriangleEdges(const std::vector<Point>& nodes, const std::vector<std::array<int, 3>>& triangles)
    : of_triangle_(triangles.size()), first_at_node_(nodes.size(), none) {
  const int node_count = static_cast<int>(nodes.size());
  nodes_.reserve(triangles.size() * 3 / 2 + 16);
  triangles_.reserve(nodes_.capacity());
  next_.reserve(nodes_.capacity());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const int node : triangles[t]) {
      if (node < 0 || node >= node_count) {
        throw InputError("triangle " + std::to_string(t) + " names node " + std::to_string(node) +
                         " (there are nodes 0 to " + std::to_string(node_count - 1) + ")");
      }
    }
    for (int k = 0; k < 3; ++k) {
      const int a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      int edge = find(a, b);
      if (edge == none) {
        edge = size();
        nodes_.push_back({a, b});
        triangles_.push_back({static_cast<int>(t), none});
        next_.push_back(first_at_node_[std::min(a, b)]);
        first_at_node_[std::min(a, b)] = edge;
      } else {
        const std::string where = to_text(0.5 * (nodes[a] + nodes[b]));
        if (triangles_[edge][1] != none) {
          throw InputError("more than two triangles meet at the edge at " + where + " (the mesh is not a plane one)");
        }
        if (nodes_[edge][0] == a) {
          throw InputError("two triangles lie on the same side of the edge at " + where +
                           " (the mesh overlaps itself)");
        }
        triangles_[edge][1] = static_cast<int>(t);
      }
      of_triangle_[t][k] = edge;
    }
  }
}

int TriangleEdges::find(int a, int b) const {
  if (std::min(a, b) < 0 || std::max(a, b) >= static_cast<int>(first_at_node_.size())) return none;
  for (int edge = first_at_node_[std::min(a, b)]; edge != none; edge = next_[edge]) {
    if (std::max(nodes_[edge][0], nodes_[edge][1]) == std::max(a, b)) return edge;
  }
  return none;
}

}  // namespace sprekk
