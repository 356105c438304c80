#include "framework/discretization/subface.hpp"

#include <cmath>

#include "framework/mesh/plane/planar.hpp"

namespace sprekk {

double share_at_node(const Mesh&, int, int) { return 0.5; }

ContinuityPoint continuity_point(const Mesh& mesh, int face, int node) {
  const Point way = mesh.nodes[node] - mesh.face_center[face];
  for (const int cell : mesh.face_cells[face])
    if (cell != none && mesh.cell_nodes[cell].size() == 3) return {way, 1.0 / 3};
  return {way, 0};
}

std::array<Point, 1> ways_along_face(const Mesh& mesh, int face, int node) {
  return {mesh.nodes[node] - mesh.face_center[face]};
}

double subcell_measure(const Point& center, const Point& node, const std::array<Point, 2>& face_centers,
                       const std::array<Point, 2>&) {
  return 0.5 * std::abs(cross(node - center, face_centers[1] - face_centers[0]));
}

}  // namespace sprekk
