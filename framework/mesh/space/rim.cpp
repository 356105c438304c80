#include "framework/mesh/space/rim.hpp"

#include "framework/mesh/geometry.hpp"

namespace sprekk {

RimEdge rim_edge(const Mesh& mesh, int ridge) {
  const int cell = mesh.ridges[ridge].cells[0];
  const FractureCell& home = mesh.fracture_cells[cell];
  const FaceNodes& nodes = mesh.face_nodes[home.faces[static_cast<int>(Wall::plus)]];
  // A wall has its nodes in the order of its rock, and not in that of the fracture cell.
  const auto apart = [&](int k) {
    return (ridge_geometry(mesh.nodes, ridge_of(nodes, k)).center - mesh.ridges[ridge].center).squaredNorm();
  };
  int found = 0;
  for (int k = 1; k < static_cast<int>(nodes.size()); ++k)
    if (apart(k) < apart(found)) found = k;
  RimEdge edge{ridge_of(nodes, found), cell, {}};
  const Point along = (mesh.nodes[edge.nodes[1]] - mesh.nodes[edge.nodes[0]]).normalized(), left = -home.normal;
  Point ahead = left.cross(along).normalized();
  if (ahead.dot(mesh.ridges[ridge].center - home.center) < 0) ahead = -ahead;
  edge.axes << ahead, left, ahead.cross(left);
  return edge;
}

std::vector<RimEdge> rim_at(const Mesh& mesh, int node) {
  std::vector<RimEdge> edges;
  for (const int face : mesh.node_faces[node]) {
    const int cell = mesh.face_fracture_cell[face];
    if (cell == none || mesh.fracture_cells[cell].faces[static_cast<int>(Wall::plus)] != face) continue;
    for (const int ridge : mesh.fracture_cells[cell].ridges)
      if (mesh.ridges[ridge].kind == Ridge::Kind::tip)
        if (const RimEdge edge = rim_edge(mesh, ridge); edge.nodes[0] == node || edge.nodes[1] == node)
          edges.push_back(edge);
  }
  return edges;
}

std::vector<char> nodes_of_rims(const Mesh& mesh) {
  std::vector<char> is_rim(mesh.node_count(), 0);
  for (int ridge = 0; ridge < static_cast<int>(mesh.ridges.size()); ++ridge)
    if (mesh.ridges[ridge].kind == Ridge::Kind::tip)
      for (const int node : rim_edge(mesh, ridge).nodes) is_rim[node] = 1;
  return is_rim;
}

}  // namespace sprekk
