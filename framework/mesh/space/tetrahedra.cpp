#include "framework/mesh/tetrahedra.hpp"

#include <Eigen/Geometry>

#include "framework/invariants.hpp"

namespace sprekk {

std::vector<Tetrahedron> tetrahedra_of(const Mesh& mesh, int cell) {
  SPREKK_EXPECT(is_index(cell, mesh.cell_count()), cell, mesh.cell_count());
  const CellNodes& corners = mesh.cell_nodes[cell];
  const auto node = [&](int k) { return mesh.nodes[corners[k]]; };
  if (corners.size() == 4) return {{{node(0), node(1), node(2), node(3)}, mesh.cell_measure[cell]}};
  std::vector<Tetrahedron> parts;
  const Point& center = mesh.cell_center[cell];
  const auto add = [&](const Point& a, const Point& b, const Point& c) {
    parts.push_back({{a, b, c, center}, (a - center).dot((b - center).cross(c - center)) / 6});
  };
  for (int f = 0; f < mesh.cell_faces[cell].size(); ++f) {
    const FaceNodes face = nodes_of_face(corners, f);
    Point mean = Point::Zero();
    for (const int k : face) mean += mesh.nodes[k] / face.size();
    const auto at = [&](int k) { return mesh.nodes[face[k]]; };
    if (face.size() == 3) {
      add(at(0), at(1), at(2));
      continue;
    }
    for (int k = 0; k < face.size(); ++k) add(at(k), mesh.nodes[face.after(k)], mean);
  }
  return parts;
}

}  // namespace sprekk
