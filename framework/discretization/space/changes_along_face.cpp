#include "framework/discretization/changes_along_face.hpp"

#include <algorithm>
#include <cmath>

namespace sprekk {
namespace {

AlongFace along(const std::array<Point, 2>& directions, const Point& way) {
  const double first = directions[0].squaredNorm(), second = directions[1].squaredNorm(),
               both = directions[0].dot(directions[1]), determinant = first * second - both * both;
  const double on_first = directions[0].dot(way), on_second = directions[1].dot(way);
  return {(second * on_first - both * on_second) / determinant, (first * on_second - both * on_first) / determinant};
}

Point mean_of_nodes(const Mesh& mesh, const FaceNodes& nodes) {
  Point sum = Point::Zero();
  for (const int node : nodes) sum += mesh.nodes[node];
  return sum / nodes.size();
}

}  // namespace

std::array<Point, 2> directions_of_face(const Mesh& mesh, int face) {
  const FaceNodes& nodes = mesh.face_nodes[face];
  const auto between = [&](int from, int to) { return Point(mesh.nodes[nodes[to]] - mesh.nodes[nodes[from]]); };
  if (nodes.size() == 3) return {between(0, 1), between(0, 2)};
  return {0.5 * (between(0, 1) + between(3, 2)), 0.5 * (between(0, 3) + between(1, 2))};
}

AlongFace position_along_face(const Mesh& mesh, int face, int, const ContinuityPoint& point) {
  return along(directions_of_face(mesh, face), point.part * point.way);
}

LinearOnFace linear_on_face(const Mesh& mesh, int face, const std::function<double(const Point&)>& value) {
  const FaceNodes& nodes = mesh.face_nodes[face];
  const Point& center = mesh.face_center[face];
  std::array<double, 4> at{};
  for (int k = 0; k < nodes.size(); ++k) at[k] = value(center + (mesh.nodes[nodes[k]] - center) / 3);
  if (nodes.size() == 3) return {(at[0] + at[1] + at[2]) / 3, {3 * (at[1] - at[0]), 3 * (at[2] - at[0])}};
  const AlongFace changes{3 * (at[1] + at[2] - at[0] - at[3]) / 2, 3 * (at[2] + at[3] - at[0] - at[1]) / 2};
  // Around the mean of the nodes, a third of the way to which the mean of the points lies.
  const AlongFace to_mean = along(directions_of_face(mesh, face), mean_of_nodes(mesh, nodes) - center);
  return {(at[0] + at[1] + at[2] + at[3]) / 4 - (to_mean[0] * changes[0] + to_mean[1] * changes[1]) / 3, changes};
}

double highest_along_face(const Mesh& mesh, int face, const AlongFace& changes) {
  if (mesh.face_nodes[face].size() == 3) return std::max({0.0, changes[0], changes[1]}) - (changes[0] + changes[1]) / 3;
  const AlongFace to_mean =
      along(directions_of_face(mesh, face), mean_of_nodes(mesh, mesh.face_nodes[face]) - mesh.face_center[face]);
  return to_mean[0] * changes[0] + to_mean[1] * changes[1] + 0.5 * (std::abs(changes[0]) + std::abs(changes[1]));
}

}  // namespace sprekk
