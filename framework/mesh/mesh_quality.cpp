#include "framework/mesh/mesh_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprekk {
namespace {

double angle_at(const Point& corner, const Point& a, const Point& b) {
  const Point u = a - corner, v = b - corner;
  return std::atan2(std::abs(u.x() * v.y() - u.y() * v.x()), u.dot(v));
}

}  // namespace

MeshQuality mesh_quality(const Mesh& mesh) {
  MeshQuality quality;
  quality.cells = mesh.cell_count();
  quality.faces = mesh.face_count();
  quality.nodes = mesh.node_count();
  quality.fractures = static_cast<int>(mesh.fractures.size());
  quality.fracture_cells = mesh.fracture_cell_count();
  if (mesh.cell_count() == 0) return quality;
  for (const FractureCell& cell : mesh.fracture_cells) quality.fracture_length += cell.length;

  quality.smallest_angle = std::numeric_limits<double>::infinity();
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    quality.area += mesh.cell_area[cell];
    double smallest = std::numeric_limits<double>::infinity();
    int outer_faces = 0;
    for (int k = 0; k < 3; ++k) {
      const auto& nodes = mesh.cell_nodes[cell];
      const double angle =
          angle_at(mesh.nodes[nodes[k]], mesh.nodes[nodes[(k + 1) % 3]], mesh.nodes[nodes[(k + 2) % 3]]);
      smallest = std::min(smallest, angle);
      quality.largest_angle = std::max(quality.largest_angle, angle);
      if (mesh.face_cells[mesh.cell_faces[cell][k]][1] == none) ++outer_faces;
    }
    quality.smallest_angle = std::min(quality.smallest_angle, smallest);
    quality.mean_smallest_angle += smallest / mesh.cell_count();
    if (outer_faces > 1) ++quality.cells_with_one_neighbour;
  }
  const auto [shortest, longest] = std::minmax_element(mesh.face_length.begin(), mesh.face_length.end());
  quality.shortest_face = *shortest;
  quality.longest_face = *longest;
  for (const double length : mesh.face_length) quality.mean_face += length / mesh.face_count();
  return quality;
}

}  // namespace sprekk
