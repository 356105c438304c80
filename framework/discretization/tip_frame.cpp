#include "framework/discretization/tip_frame.hpp"

#include <cmath>
#include <numbers>

#include "framework/invariants.hpp"

namespace sprekk {

TipFrame::TipFrame(const Mesh& mesh, int tip) : tip_(mesh.nodes[tip]) {
  SPREKK_EXPECT(is_index(tip, mesh.node_count()), tip, mesh.node_count());
  for (const int face : mesh.node_faces[tip]) {
    if (mesh.face_fracture_cell[face] == none) continue;
    const Point ahead = (tip_ - mesh.face_center[face]).normalized();
    axes_ << ahead.x(), -ahead.y(), ahead.y(), ahead.x();
    size_ = mesh.face_length[face];
    SPREKK_ASSERT(size_ > 0, tip, face, size_);
  }
}

int TipFrame::side_of(const Point& x) const { return axes_.col(1).dot(x - tip_) < 0 ? -1 : 1; }

int TipFrame::side_of_wall(const Mesh& mesh, int face) const {
  SPREKK_EXPECT(is_index(face, mesh.face_count()) && mesh.face_fracture_cell[face] != none, face);
  const FractureCell& cell = mesh.fracture_cells[mesh.face_fracture_cell[face]];
  const bool normal_points_left = axes_.col(1).dot(cell.normal) > 0;
  const bool is_plus = cell.faces[static_cast<int>(Wall::plus)] == face;
  return is_plus == normal_points_left ? -1 : 1;  // the normal points out of the plus wall's rock
}

int TipFrame::side_of_cell(const Mesh& mesh, int cell) const {
  for (const int face : mesh.cell_faces[cell])
    if (mesh.face_fracture_cell[face] != none) return side_of_wall(mesh, face);
  return 0;
}

TipFrame::Polar TipFrame::polar(const Point& x, int side) const {
  SPREKK_EXPECT(side >= -1 && side <= 1, side);
  const Point local = axes_.transpose() * (x - tip_);
  const double angle = std::atan2(local.y(), local.x());
  // A fracture that bends a little leaves the line of the tip: behind the tip, `side` decides the sign of the angle.
  const bool is_beyond = angle * side < 0 && std::abs(local.y()) < -0.5 * local.x();
  return {local.norm(), is_beyond ? angle + 2 * std::numbers::pi * side : angle};
}

}  // namespace sprekk
