#include <algorithm>
#include <limits>

#include "framework/invariants.hpp"
#include "framework/mesh/corner_weights.hpp"

namespace sprekk {

int cell_holding(const Mesh& mesh, const std::vector<int>& cells, const Point& x) {
  SPREKK_EXPECT(!cells.empty());
  int best = cells.front();
  double deepest = -std::numeric_limits<double>::infinity();
  for (const int cell : cells) {
    double depth = std::numeric_limits<double>::infinity();
    for (const int face : mesh.cell_faces[cell]) {
      const double outward = mesh.face_cells[face][0] == cell ? 1 : -1;
      depth = std::min(depth, outward * mesh.face_normal[face].dot(mesh.face_center[face] - x));
    }
    if (depth <= deepest) continue;
    deepest = depth;
    best = cell;
  }
  return best;
}

}  // namespace sprekk
