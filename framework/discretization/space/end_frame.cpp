#include "framework/discretization/end_frame.hpp"

#include <algorithm>

#include "framework/invariants.hpp"
#include "framework/mesh/space/rim.hpp"

namespace sprekk {

EndFrame::EndFrame(const Mesh& mesh, int end) : end_(end), origin_(mesh.nodes[end]) {
  const std::vector<RimEdge> rim = rim_at(mesh, end);
  SPREKK_EXPECT(!rim.empty(), end);
  const FractureCell& last = mesh.fracture_cells[rim[0].cell];
  fracture_ = last.fracture;
  const auto length = [&](const RimEdge& edge) {
    return (mesh.nodes[edge.nodes[1]] - mesh.nodes[edge.nodes[0]]).norm();
  };
  size_ = last.measure / length(rim[0]);
  axes_ = {rim[0].axes, rim.back().axes};
  const std::array<int, 2>& other = rim.back().nodes;
  const Point away = mesh.nodes[other[0] == end ? other[1] : other[0]] - origin_;
  bends_back_ = axes_[0].col(0).dot(away) <= 0;
}

const Tensor& EndFrame::axes_near(const Point& x) const {
  const Point from = x - origin_;
  const bool is_first_ahead = axes_[0].col(0).dot(from) >= axes_[1].col(0).dot(from);
  return axes_[is_first_ahead == bends_back_ ? 0 : 1];
}

int EndFrame::side_of(const Point& x) const { return axes_near(x).col(1).dot(x - origin_) < 0 ? -1 : 1; }

int EndFrame::side_of_wall(const Mesh& mesh, int face) const {
  SPREKK_EXPECT(is_index(face, mesh.face_count()) && mesh.face_fracture_cell[face] != none, face);
  return mesh.fracture_cells[mesh.face_fracture_cell[face]].faces[static_cast<int>(Wall::plus)] == face ? 1 : -1;
}

int EndFrame::side_of_cell(const Mesh& mesh, int cell) const {
  for (const int face : mesh.cell_faces[cell])
    if (const int wall = mesh.face_fracture_cell[face]; wall != none && mesh.fracture_cells[wall].fracture == fracture_)
      return side_of_wall(mesh, face);
  return std::ranges::count(mesh.cell_nodes[cell], end_) > 0 ? 0 : side_of(mesh.cell_center[cell]);
}

}  // namespace sprekk
