#include "framework/mesh/search/distances.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "framework/mesh/tetrahedra.hpp"

namespace sprekk {
namespace {

double distance_to_segment(const Point& x, const Point& from, const Point& to) {
  const Point along = to - from;
  const double part = std::clamp((x - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (x - from - part * along).norm();
}

}  // namespace

double depth_below_face(const Mesh& mesh, int cell, int k, const Point& x) {
  const int face = mesh.cell_faces[cell][k];
  const double outward = mesh.face_cells[face][0] == cell ? 1 : -1;
  return outward * mesh.face_normal[face].dot(mesh.face_center[face] - x) * mesh.face_measure[face];
}

bool parts_hold(const Mesh& mesh, int cell, const Point& x, double slack) {
  if (mesh.cell_nodes[cell].size() == 4) return false;
  const auto holds = [&](const Tetrahedron& part) {
    for (int k = 0; k < 4; ++k) {
      const auto corner = [&](int i) -> const Point& { return part.corners[(k + i) % 4]; };
      const Point normal = (corner(2) - corner(1)).cross(corner(3) - corner(1));
      const double inward = normal.dot(corner(0) - corner(1)) < 0 ? -1 : 1;
      if (inward * normal.dot(x - corner(1)) < -slack * normal.norm()) return false;
    }
    return true;
  };
  return std::ranges::any_of(tetrahedra_of(mesh, cell), holds);
}

double distance_to_fracture_cell(const Mesh& mesh, int cell, const Point& x) {
  const FractureCell& home = mesh.fracture_cells[cell];
  const FaceNodes& corners = mesh.face_nodes[home.faces[0]];
  double to_edges = std::numeric_limits<double>::infinity();
  int left = 0, right = 0;
  for (int k = 0; k < corners.size(); ++k) {
    const Point &from = mesh.nodes[corners[k]], &to = mesh.nodes[corners.after(k)];
    to_edges = std::min(to_edges, distance_to_segment(x, from, to));
    ++(home.normal.dot((to - from).cross(x - from)) > 0 ? left : right);
  }
  const bool is_above = left == 0 || right == 0;  // its foot lies in the cell
  return is_above ? std::abs(home.normal.dot(x - home.center)) : to_edges;
}

}  // namespace sprekk
