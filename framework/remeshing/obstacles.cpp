#include "framework/remeshing/obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// Whether an edge lies on the line through another one.
bool is_in_line(const Segment& edge, const Segment& line) {
  const Point along = line.to - line.from;
  return std::max(std::abs(cross(along, edge.from - line.from)), std::abs(cross(along, edge.to - line.from))) <=
         rounding::far_above * along.norm() * std::max(line.length(), (edge.to - line.from).norm());
}

/// Makes a line as long as an edge on it reaches.
void stretch(const Segment& edge, Segment& line) {
  const Point along = line.to - line.from;
  for (const Point& x : {edge.from, edge.to}) {
    if ((x - line.from).dot(along) < 0) line.from = x;
    if ((x - line.to).dot(along) > 0) line.to = x;
  }
}

}  // namespace

Segment cell_segment(const Mesh& mesh, int fracture_cell) {
  const auto [a, b] = mesh.fracture_cells[fracture_cell].ridges;
  return {mesh.ridges[a].center, mesh.ridges[b].center};
}

Segment face_segment(const Mesh& mesh, int face) {
  return {mesh.nodes[mesh.face_nodes[face][0]], mesh.nodes[mesh.face_nodes[face][1]]};
}

Segment straight_side(const Mesh& mesh, int face) {
  const Segment given = face_segment(mesh, face);
  Segment line = given;
  for (int other = 0; other < mesh.face_count(); ++other) {
    if (mesh.face_side[other] != mesh.face_side[face]) continue;
    const Segment edge = face_segment(mesh, other);
    if (is_in_line(edge, given)) stretch(edge, line);
  }
  return line;
}

Segment straight_part(const Mesh& mesh, int fracture_cell) {
  const auto& [name, first, count] = mesh.fractures[mesh.fracture_cells[fracture_cell].fracture];
  const Segment given = cell_segment(mesh, fracture_cell);
  Segment line = given;
  for (const int step : {1, -1}) {
    for (int cell = fracture_cell + step; cell >= first && cell < first + count; cell += step) {
      const Segment edge = cell_segment(mesh, cell);
      if (!is_in_line(edge, given)) break;
      stretch(edge, line);
    }
  }
  return line;
}

}  // namespace sprekk
