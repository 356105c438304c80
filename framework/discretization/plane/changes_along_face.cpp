#include "framework/discretization/changes_along_face.hpp"

#include <cmath>

namespace sprekk {

std::array<Point, 1> directions_of_face(const Mesh& mesh, int face) {
  return {mesh.nodes[mesh.face_nodes[face][1]] - mesh.nodes[mesh.face_nodes[face][0]]};
}

AlongFace position_along_face(const Mesh& mesh, int face, int node, const ContinuityPoint& point) {
  return {0.5 * (mesh.face_nodes[face][0] == node ? -1 : 1) * point.part};
}

LinearOnFace linear_on_face(const Mesh& mesh, int face, const std::function<double(const Point&)>& value) {
  const Point third = directions_of_face(mesh, face)[0] / 6;
  const double first = value(mesh.face_center[face] - third), second = value(mesh.face_center[face] + third);
  return {0.5 * (first + second), {3 * (second - first)}};
}

double highest_along_face(const Mesh&, int, const AlongFace& changes) { return 0.5 * std::abs(changes[0]); }

}  // namespace sprekk
