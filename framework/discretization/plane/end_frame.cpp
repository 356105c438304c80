#include "framework/discretization/end_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/invariants.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk {
namespace {

constexpr int most_cells = 32;  ///< behind an end, of which the side of a point is told

/// The ends of the cells of a fracture, from that of its last cell, or of its first one, backwards.
std::vector<Point> line_from(const Mesh& mesh, int cell, bool at_end) {
  const Fracture& fracture = mesh.fractures[mesh.fracture_cells[cell].fracture];
  const auto end_of = [&](int i, int k) { return mesh.ridges[mesh.fracture_cells[i].ridges[k]].center; };
  std::vector<Point> line{end_of(cell, at_end ? 1 : 0)};
  for (int k = 0; k < std::min(most_cells, fracture.cell_count); ++k)
    line.push_back(end_of(at_end ? cell - k : cell + k, at_end ? 0 : 1));
  return line;
}

}  // namespace

EndFrame::EndFrame(const Mesh& mesh, int end) : end_(end), origin_(mesh.nodes[end]) {
  SPREKK_EXPECT(is_index(end, mesh.node_count()), end, mesh.node_count());
  const auto& faces = mesh.node_faces[end];
  const auto wall = std::ranges::find_if(faces, [&](int face) { return mesh.face_fracture_cell[face] != none; });
  SPREKK_EXPECT(wall != std::end(faces), end);
  const Point ahead = (origin_ - mesh.face_center[*wall]).normalized();
  axes_[0] << ahead.x(), -ahead.y(), ahead.y(), ahead.x();
  size_ = mesh.face_measure[*wall];
  SPREKK_ASSERT(size_ > 0, end, *wall, size_);
  const FractureCell& cell = mesh.fracture_cells[mesh.face_fracture_cell[*wall]];
  fracture_ = cell.fracture;
  line_ = line_from(mesh, mesh.face_fracture_cell[*wall], ahead.dot(cell.tangents) > 0);
}

int EndFrame::side_of(const Point& x) const {
  const auto ahead = [&](std::size_t i) { return Point((line_[i] - line_[i + 1]).normalized()); };
  const std::size_t last = line_.size() - 2;
  double least = std::numeric_limits<double>::infinity(), side = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    const Point along = line_[i + 1] - line_[i];
    const double part = std::clamp(along.dot(x - line_[i]) / along.squaredNorm(), 0.0, 1.0);
    const Point near = line_[i] + part * along;
    const double distance = (x - near).norm();
    if (distance >= least) continue;
    least = distance;
    // Where the nearest place is a bend, both pieces count alike.
    Point direction = ahead(i);
    if (part == 0 && i > 0) direction += ahead(i - 1);
    if (part == 1 && i < last) direction += ahead(i + 1);
    side = cross(direction, x - near);
  }
  return side < 0 ? -1 : 1;
}

int EndFrame::side_of_wall(const Mesh& mesh, int face) const {
  SPREKK_EXPECT(is_index(face, mesh.face_count()) && mesh.face_fracture_cell[face] != none, face);
  const FractureCell& cell = mesh.fracture_cells[mesh.face_fracture_cell[face]];
  const bool normal_points_left = axes().col(1).dot(cell.normal) > 0;
  const bool is_plus = cell.faces[static_cast<int>(Wall::plus)] == face;
  return is_plus == normal_points_left ? -1 : 1;  // the normal points out of the plus wall's rock
}

int EndFrame::side_of_cell(const Mesh& mesh, int cell) const {
  for (const int face : mesh.cell_faces[cell])
    if (const int wall = mesh.face_fracture_cell[face]; wall != none && mesh.fracture_cells[wall].fracture == fracture_)
      return side_of_wall(mesh, face);
  return std::ranges::count(mesh.cell_nodes[cell], end_) > 0 ? 0 : side_of(mesh.cell_center[cell]);
}

const Tensor& EndFrame::axes_near(const Point&) const { return axes_[0]; }

}  // namespace sprekk
