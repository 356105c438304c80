#include "framework/meshing/space/outer_sides.hpp"

#include <cmath>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/geometry.hpp"

namespace sprekk {

void take_outer_sides(const Box& box, RawMesh& mesh) {
  mesh.side_names.assign(box_sides.begin(), box_sides.end());
  const FaceTable faces(mesh.nodes, mesh.cells);
  for (int face = 0; face < faces.size(); ++face) {
    if (!faces.is_outer(face)) continue;
    const Point center = face_geometry(mesh.nodes, faces.nodes(face)).center;
    const auto distance = [&](int side) {
      return std::abs(center[side / 2] - (side % 2 == 0 ? box.low : box.high)[side / 2]);
    };
    int nearest = 0;
    for (int side = 1; side < static_cast<int>(box_sides.size()); ++side)
      if (distance(side) < distance(nearest)) nearest = side;
    mesh.boundary_faces.push_back({faces.nodes(face), nearest});
  }
  for (const auto& [nodes, side] : mesh.boundary_faces)
    for (const int node : nodes) mesh.nodes[node][side / 2] = (side % 2 == 0 ? box.low : box.high)[side / 2];
}

}  // namespace sprekk
