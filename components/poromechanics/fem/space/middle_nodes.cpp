#include "components/poromechanics/fem/middle_nodes.hpp"

namespace sprekk::poromechanics {

namespace {

/// Of a tetrahedron, one bit for each corner at a rim. Of a wedge, the corner of its triangle that is alone at a rim,
/// or alone off it; 1 where there is none.
int start_of_rays(const CellNodes& corners, const CellEdges& edges) {
  int at_rim = 0, count = 0;  // one bit each
  const int size = corners.size() == 4 ? 4 : 3;
  for (int k = 0; k < corners.size(); ++k)
    if (edges.is_at_rim[corners[k]]) at_rim |= 1 << (k % size);
  if (corners.size() == 4) return at_rim;
  for (int k = 0; k < size; ++k) count += (at_rim >> k) & 1;
  for (int k = 0; k < size; ++k)
    if ((count == 1 || count == 2) && ((at_rim >> k) & 1) == (count == 1)) return k;
  return 1;
}

}  // namespace

MiddleNodes middle_nodes(const Mesh& mesh, int cell, const std::vector<int>& /*tips*/, const CellEdges* edges) {
  const CellNodes& corners = mesh.cell_nodes[cell];
  MiddleNodes middle{{}, std::vector<Point>(mesh.cell_faces[cell].size(), Point::Zero()), corners.size() == 6 ? 1 : 0};
  if (!edges || edges->count() == 0) return middle;
  for (const int edge : edges->of_cell[cell])
    middle.of_edges.push_back(edge == none ? Point(Point::Zero()) : edges->shift(mesh, edge));
  if (edges->are_in(cell)) middle.start = start_of_rays(corners, *edges);
  return middle;
}

}  // namespace sprekk::poromechanics
