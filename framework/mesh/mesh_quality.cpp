#include "framework/mesh/mesh_quality.hpp"

#include <algorithm>
#include <limits>

#include "framework/invariants.hpp"
#include "framework/mesh/cell_shape.hpp"

namespace sprekk {
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
    quality.smallest_angle = std::min(quality.smallest_angle, smallest);
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

}  // namespace sprekk
