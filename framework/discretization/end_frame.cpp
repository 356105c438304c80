#include "framework/discretization/end_frame.hpp"

#include <cmath>
#include <numbers>

#include "framework/invariants.hpp"

namespace sprekk {

EndFrame::EndFrame(const Mesh& mesh, int end) : origin_(mesh.nodes[end]) {
  SPREKK_EXPECT(is_index(end, mesh.node_count()), end, mesh.node_count());
  for (const int face : mesh.node_faces[end]) {
    if (mesh.face_fracture_cell[face] == none) continue;
    const Point ahead = (origin_ - mesh.face_center[face]).normalized();
    axes_ << ahead.x(), -ahead.y(), ahead.y(), ahead.x();
    size_ = mesh.face_measure[face];
    SPREKK_ASSERT(size_ > 0, end, face, size_);
  }
}

int EndFrame::side_of(const Point& x) const { return axes_.col(1).dot(x - origin_) < 0 ? -1 : 1; }

int EndFrame::side_of_wall(const Mesh& mesh, int face) const {
  SPREKK_EXPECT(is_index(face, mesh.face_count()) && mesh.face_fracture_cell[face] != none, face);
  const FractureCell& cell = mesh.fracture_cells[mesh.face_fracture_cell[face]];
  const bool normal_points_left = axes_.col(1).dot(cell.normal) > 0;
  const bool is_plus = cell.faces[static_cast<int>(Wall::plus)] == face;
  return is_plus == normal_points_left ? -1 : 1;  // the normal points out of the plus wall's rock
}

int EndFrame::side_of_cell(const Mesh& mesh, int cell) const {
  for (const int face : mesh.cell_faces[cell])
    if (mesh.face_fracture_cell[face] != none) return side_of_wall(mesh, face);
  return 0;
}

EndFrame::Polar EndFrame::polar(const Point& x, int side) const {
  SPREKK_EXPECT(side >= -1 && side <= 1, side);
  const Point local = axes_.transpose() * (x - origin_);
  const double angle = std::atan2(local.y(), local.x());
  // Behind the end a fracture with a slight bend is beside the line through the end, so `side` decides the sign there.
  const bool is_beyond = angle * side < 0 && std::abs(local.y()) < -0.5 * local.x();
  return {local.norm(), is_beyond ? angle + 2 * std::numbers::pi * side : angle};
}

}  // namespace sprekk
