#include "framework/discretization/subface.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "framework/invariants.hpp"

namespace sprekk {
namespace {

int place_of(int node, const FaceNodes& nodes) {
  const int place = static_cast<int>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
  SPREKK_EXPECT(place < nodes.size(), node);
  return place;
}

/// The node at the other end of the edge that joins both triangles of a wedge.
int across_wedge(const CellNodes& wedge, int node) {
  const int place = static_cast<int>(std::find(wedge.begin(), wedge.end(), node) - wedge.begin());
  return wedge[(place + 3) % 6];
}

/// The middle of the edge, at this node, between the triangles of a wedge.
Point middle_of_edge(const Mesh& mesh, const CellNodes& wedge, int node) {
  return 0.5 * (mesh.nodes[node] + mesh.nodes[across_wedge(wedge, node)]);
}

}  // namespace

double share_in_space(const Mesh& mesh, int face, int node) {
  const FaceNodes& nodes = mesh.face_nodes[face];
  if (nodes.size() == 3) return 1.0 / 3;
  const int k = place_of(node, nodes);
  const Point mean = (mesh.nodes[nodes[0]] + mesh.nodes[nodes[1]] + mesh.nodes[nodes[2]] + mesh.nodes[nodes[3]]) / 4;
  const Point across = 0.5 * (mesh.nodes[nodes.before(k)] - mesh.nodes[nodes.after(k)]);
  return 0.5 * (mean - mesh.nodes[node]).cross(across).dot(mesh.face_normal[face]) / mesh.face_measure[face];
}

ContinuityPoint continuity_point_in_space(const Mesh& mesh, int face, int node) {
  const FaceNodes& nodes = mesh.face_nodes[face];
  const Point to_node = mesh.nodes[node] - mesh.face_center[face];
  if (nodes.size() == 3) {
    for (const int cell : mesh.face_cells[face])
      if (cell != none && mesh.cell_nodes[cell].size() == 4) return {to_node, 1.0 / 4};
    return {to_node, 0};
  }
  // Two wedges beside a face may have their triangles at different edges of it: then between both.
  int wedges = 0;
  Point way = Point::Zero();
  for (const int cell : mesh.face_cells[face]) {
    if (cell == none || mesh.cell_nodes[cell].size() != 6) continue;
    const CellNodes& wedge = mesh.cell_nodes[cell];
    Point mean = Point::Zero();
    for (const int other : nodes) mean += share_in_space(mesh, face, other) * middle_of_edge(mesh, wedge, other);
    way += middle_of_edge(mesh, wedge, node) - mean;
    ++wedges;
  }
  if (wedges == 0) return {to_node, 0};
  return {way / wedges, 1.0 / 3};
}

std::array<Point, 2> ways_along_face(const Mesh& mesh, int face, int node) {
  const Point &normal = mesh.face_normal[face], to_node = mesh.nodes[node] - mesh.face_center[face];
  return {to_node - normal.dot(to_node) * normal, normal.cross(to_node)};
}

}  // namespace sprekk
