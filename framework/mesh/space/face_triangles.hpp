// The triangles by which a face in space is represented.
#pragma once

#include <vector>

#include "framework/mesh/shapes.hpp"

namespace sprekk {

/// Calls use(a, b, c) for each triangle of a face: itself, or those between its edges and the mean of its nodes.
template <class Use>
void for_each_triangle(const std::vector<Point>& nodes, const FaceNodes& face, const Use& use) {
  if (face.size() == 3) return use(nodes[face[0]], nodes[face[1]], nodes[face[2]]);
  Point middle = Point::Zero();
  for (const int node : face) middle += nodes[node];
  middle /= face.size();
  for (int k = 0; k < face.size(); ++k) use(nodes[face[k]], nodes[face.after(k)], middle);
}

}  // namespace sprekk
