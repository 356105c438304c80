#include "framework/mesh/search/distances.hpp"

#include "framework/mesh/plane/planar.hpp"

namespace sprekk {

double depth_below_face(const Mesh& mesh, int cell, int k, const Point& x) {
  const Ring& corners = mesh.cell_nodes[cell];
  const Point &a = mesh.nodes[corners[k]], &b = mesh.nodes[corners.after(k)];
  return cross(b - a, x - a);
}

bool parts_hold(const Mesh&, int, const Point&, double) { return false; }

double distance_to_fracture_cell(const Mesh& mesh, int cell, const Point& x) {
  const auto [from, to] = mesh.fracture_cells[cell].ridges;
  return distance(x, Segment{mesh.ridges[from].center, mesh.ridges[to].center});
}

}  // namespace sprekk
