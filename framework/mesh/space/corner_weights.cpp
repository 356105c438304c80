#include "framework/mesh/corner_weights.hpp"

#include <Eigen/Geometry>
#include <array>

#include "framework/invariants.hpp"

namespace sprekk {

// At each corner of a tetrahedron, a wedge or a hexahedron three faces meet, as Wachspress' coordinates need (Warren,
// Adv. Comput. Math. 6 (1996) 97).
std::vector<std::pair<int, double>> corner_weights(const Mesh& mesh, int cell, const Point& x) {
  SPREKK_EXPECT(is_index(cell, mesh.cell_count()), cell, mesh.cell_count());
  const CellFaces& faces = mesh.cell_faces[cell];
  std::array<Point, 6> outward;
  std::array<double, 6> depth;
  for (int k = 0; k < faces.size(); ++k) {
    outward[k] = (mesh.face_cells[faces[k]][0] == cell ? 1 : -1) * mesh.face_normal[faces[k]];
    depth[k] = outward[k].dot(mesh.face_center[faces[k]] - x);
  }
  std::vector<std::pair<int, double>> weights;
  double sum = 0;
  for (const int corner : mesh.cell_nodes[cell]) {
    // The volume that the normals at the corner span, times the distances of the faces that do not touch it.
    Tensor normals;
    int found = 0;
    double weight = 1;
    for (int k = 0; k < faces.size(); ++k) {
      const FaceNodes& nodes = mesh.face_nodes[faces[k]];
      if (std::find(nodes.begin(), nodes.end(), corner) == nodes.end())
        weight *= depth[k];
      else
        normals.col(found++) = outward[k];
    }
    SPREKK_ASSERT(found == dimension, cell, found);
    weight *= std::abs(normals.determinant());
    weights.emplace_back(corner, weight);
    sum += weight;
  }
  SPREKK_ASSERT(sum != 0, cell, sum);
  for (auto& [node, weight] : weights) weight /= sum;
  return weights;
}

}  // namespace sprekk
