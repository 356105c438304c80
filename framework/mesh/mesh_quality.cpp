#include "framework/mesh/mesh_quality.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <set>

#include "framework/invariants.hpp"
#include "framework/mesh/cell_shape.hpp"
#include "framework/mesh/planar.hpp"

namespace sprekk {

namespace {

/// The names of fractures on whose walls corners of the cell lie.
std::set<std::string> fractures_at_corners(const Mesh& mesh, int cell) {
  std::set<std::string> names;
  const auto corners = mesh.cell_nodes[cell];
  for (const FractureCell& wall : mesh.fracture_cells)
    for (const int face : wall.faces)
      for (const int node : mesh.face_nodes[face])
        if (std::find(corners.begin(), corners.end(), node) != corners.end())
          names.insert("'" + mesh.fractures[wall.fracture].name + "'");
  return names;
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
  for (const FractureCell& cell : mesh.fracture_cells) quality.fracture_length += cell.measure;

  quality.smallest_angle = std::numeric_limits<double>::infinity();
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    quality.area += mesh.cell_measure[cell];
    const auto [smallest, largest] = angles(mesh.nodes, mesh.cell_nodes[cell]);
    int outer_faces = 0;
    for (const int face : mesh.cell_faces[cell]) outer_faces += mesh.face_cells[face][1] == none ? 1 : 0;
    quality.largest_angle = std::max(quality.largest_angle, largest);
    if (smallest < quality.smallest_angle) {
      quality.smallest_angle = smallest;
      quality.flattest_cell = cell;
    }
    quality.mean_smallest_angle += smallest / mesh.cell_count();
    if (outer_faces + 1 >= mesh.cell_faces[cell].size()) ++quality.cells_with_one_neighbour;
  }
  const auto [shortest, longest] = std::minmax_element(mesh.face_measure.begin(), mesh.face_measure.end());
  quality.shortest_face = *shortest;
  quality.longest_face = *longest;
  for (const double length : mesh.face_measure) quality.mean_face += length / mesh.face_count();
  SPREKK_ASSERT(quality.smallest_angle > 0, quality.smallest_angle);
  return quality;
}

std::string flatness_text(const Mesh& mesh, int cell) {
  SPREKK_EXPECT(is_index(cell, mesh.cell_count()), cell);
  const double degrees = angles(mesh.nodes, mesh.cell_nodes[cell]).smallest * 180 / std::numbers::pi;
  std::string text = fmt::format("an angle of {:.2g} degrees at {}", degrees, to_text(mesh.cell_center[cell]));
  const std::set<std::string> names = fractures_at_corners(mesh, cell);
  if (names.size() < 2) return text;
  double longest = 0;
  for (const int face : mesh.cell_faces[cell]) longest = std::max(longest, mesh.face_measure[face]);
  const bool is_triangle = mesh.cell_faces[cell].size() == 3;
  return text + fmt::format(", between fractures {} in a cell {:.2g} m high", fmt::join(names, " and "),
                            (is_triangle ? 2 : 1) * mesh.cell_measure[cell] / longest);
}

}  // namespace sprekk
