#include "components/poromechanics/fem/middle_nodes.hpp"

namespace sprekk::poromechanics {

MiddleNodes middle_nodes(const Mesh& mesh, int cell, const std::vector<int>& tips, const CellEdges* /*edges*/) {
  const CellNodes& corners = mesh.cell_nodes[cell];
  const CellFaces& faces = mesh.cell_faces[cell];
  MiddleNodes middle{{}, std::vector<Point>(faces.size(), Point::Zero()), 1};
  for (int k = 0; k < faces.size(); ++k) {
    const int tip = tips.empty() ? none : tips[faces[k]];
    if (tip == none) continue;
    const bool is_first = corners[k] == tip;
    const Point face = mesh.nodes[corners.after(k)] - mesh.nodes[corners[k]];
    middle.of_faces[k] = (is_first ? -1 : 1) * face / 4;
    middle.start = is_first ? k : (k + 1) % corners.size();
  }
  return middle;
}

}  // namespace sprekk::poromechanics
