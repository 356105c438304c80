#include "framework/mesh/quality/mesh_quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/quality/cell_angles.hpp"
#include "framework/mesh/search/distances.hpp"

namespace sprekk {

namespace {

struct FractureNearby {
  int fracture;
  double distance;  ///< m
};

/// The fractures that are nearer to a point than `within` (m), the nearest first.
std::vector<FractureNearby> fractures_nearby(const Mesh& mesh, const Point& point, double within) {
  std::vector<double> distances(mesh.fractures.size(), std::numeric_limits<double>::infinity());
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    double& least = distances[mesh.fracture_cells[i].fracture];
    least = std::min(least, distance_to_fracture_cell(mesh, i, point));
  }
  std::vector<FractureNearby> nearby;
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (distances[i] < within) nearby.push_back({static_cast<int>(i), distances[i]});
  std::ranges::sort(nearby, {}, &FractureNearby::distance);
  return nearby;
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
  for (const FractureCell& cell : mesh.fracture_cells) quality.fracture_measure += cell.measure;

  quality.smallest_angle = std::numeric_limits<double>::infinity();
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    quality.measure += mesh.cell_measure[cell];
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
  const auto [smallest_face, largest_face] = std::minmax_element(mesh.face_measure.begin(), mesh.face_measure.end());
  quality.smallest_face = *smallest_face;
  quality.largest_face = *largest_face;
  for (const double measure : mesh.face_measure) quality.mean_face += measure / mesh.face_count();
  SPREKK_ASSERT(quality.smallest_angle > 0, quality.smallest_angle);
  return quality;
}

std::string flatness_text(const Mesh& mesh, int cell) {
  SPREKK_EXPECT(is_index(cell, mesh.cell_count()), cell);
  const double degrees = angles(mesh.nodes, mesh.cell_nodes[cell]).smallest * 180 / std::numbers::pi;
  std::string text = fmt::format("an angle of {:.2g} degrees at {}", degrees, to_text(mesh.cell_center[cell]));
  double longest = 0;
  for (const int face : mesh.cell_faces[cell]) longest = std::max(longest, mesh.face_measure[face]);
  constexpr double lines_of_cells = 8;  // between two fractures, at most
  const double height = mesh.cell_measure[cell] / longest;
  const std::vector<FractureNearby> near = fractures_nearby(mesh, mesh.cell_center[cell], lines_of_cells * height);
  if (near.size() < 2) return text;
  return text + fmt::format(", between fractures '{}' and '{}', which are {:.2g} m apart there",
                            mesh.fractures[std::min(near[0].fracture, near[1].fracture)].name,
                            mesh.fractures[std::max(near[0].fracture, near[1].fracture)].name,
                            near[0].distance + near[1].distance);
}

}  // namespace sprekk
