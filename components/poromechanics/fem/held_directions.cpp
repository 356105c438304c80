#include "components/poromechanics/fem/held_directions.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>
#include <tuple>
#include <utility>

#include "components/poromechanics/check_conditions.hpp"
#include "components/poromechanics/fem/face_functions.hpp"
#include "framework/linear/rigid_rotations.hpp"

namespace sprekk::poromechanics {

namespace {

/// A direction that is held; its length is the measure of the boundary that holds it.
struct Direction {
  int side, axis;  ///< of the boundary, and the direction of its condition
  Point vector;
  std::vector<HeldBy> by;
};

constexpr double same_side = 0.5;  // sine of the angle between faces of one curved side; more is a corner
// Sine of the angle between directions that hold as one: far above round-off of normals.
constexpr double parallel = 1e-3;

double sine(const Point& a, const Point& b) { return (rotated(a).transpose() * b).norm() / (a.norm() * b.norm()); }

void add(std::vector<Direction>& directions, int side, int axis, const Point& vector, const HeldBy& by) {
  for (Direction& direction : directions) {
    const bool is_same = direction.side == side && direction.axis == axis;
    if (sine(direction.vector, vector) > (is_same ? same_side : parallel)) continue;
    const double sign = direction.vector.dot(vector) < 0 ? -1 : 1;
    direction.vector += sign * vector;
    direction.by.push_back({by.face, by.axis, sign * by.share, by.pin});
    return;
  }
  directions.push_back({side, axis, vector, {by}});
}

/// How many directions determine a displacement: those with a part across the ones before.
int independent(const std::vector<Direction>& directions) {
  std::vector<Point> across;  // unit
  for (const Direction& direction : directions) {
    if (across.size() == dimension) break;
    Point rest = direction.vector.normalized();
    for (const Point& before : across) rest -= before.dot(rest) * before;
    if (rest.norm() > parallel) across.push_back(rest.normalized());
  }
  return static_cast<int>(across.size());
}

/// Orthonormal columns, with `axis` where it has its largest component and the others near to their coordinates.
std::pair<Tensor, int> axes_with(const Point& axis) {
  int place = 0;
  for (int k = 1; k < dimension; ++k)
    if (std::abs(axis[k]) > std::abs(axis[place])) place = k;
  Tensor axes = Tensor::Zero();
  axes.col(place) = axis;
  if constexpr (dimension == 2) {
    axes.col(1 - place) = Point(-axis[1], axis[0]);
  } else {
    for (int k = 0; k < dimension; ++k) {
      if (k == place) continue;
      const Point rest = Point::Unit(k) - axes * (axes.transpose() * Point::Unit(k));
      axes.col(k) = rest.normalized();
    }
  }
  return {axes, place};
}

/// The normal of the plane of directions: unit.
Point plane_normal(const std::vector<Direction>& directions) {
  Point normal = Point::Zero();
  if constexpr (dimension == 3)
    for (const Direction& other : directions) {
      const Point across = directions[0].vector.normalized().cross(other.vector.normalized());
      if (across.norm() > normal.norm()) normal = across;
    }
  return normal.normalized();
}

/// Where sides that meet contradict each other, their displacements have the least squares of what is left, by measure.
HeldDirections combined(const std::vector<Direction>& directions) {
  HeldDirections held;
  const int count = independent(directions);
  if (count == 0) return held;
  if (count == 1) {
    const auto [axes, place] = axes_with(directions[0].vector.normalized());
    held.axes = axes;
    held.is_held[place] = true;
    for (const HeldBy& by : directions[0].by)
      held.by[place].push_back({by.face, by.axis, by.share / directions[0].vector.norm(), by.pin});
    return held;
  }
  // The displacements along the held axes, from those along the directions; two in space leave the one across them.
  int free = none;
  if constexpr (dimension == 3)
    if (count == 2) std::tie(held.axes, free) = axes_with(plane_normal(directions));
  const auto given = static_cast<int>(directions.size());
  Eigen::MatrixXd vectors(given, dimension);
  Eigen::VectorXd weights(given);  // so that squares count by measure
  for (int i = 0; i < given; ++i) {
    weights[i] = 1 / std::sqrt(directions[i].vector.norm());
    vectors.row(i) = weights[i] * directions[i].vector.transpose() * held.axes;
  }
  if (free != none) vectors.col(free).setZero();
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(vectors);
  const Eigen::MatrixXd along = decomposition.pseudoInverse() * weights.asDiagonal();
  for (int k = 0; k < dimension; ++k) {
    if (k == free) continue;
    held.is_held[k] = true;
    for (int i = 0; i < given; ++i)
      for (const HeldBy& by : directions[i].by)
        held.by[k].push_back({by.face, by.axis, along(k, i) * by.share, by.pin});
  }
  return held;
}

}  // namespace

const HeldDirections& Held::of_entity(int entity) const {
  for (const std::vector<HeldDirections>* each : {&nodes, &edges}) {
    const int count = static_cast<int>(each->size());
    if (entity < count) return (*each)[entity];
    entity -= count;
  }
  return faces[entity];
}

Held held_directions(const Options& options, const Mesh& mesh, const CellEdges& edges) {
  const RawDisplacement raw{mesh, &edges};
  std::vector<std::vector<Direction>> at_nodes(mesh.node_count()), at_edges(edges.count());
  Held held;
  held.faces.resize(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f) {
    const SideCondition* condition = condition_of(options, mesh, f);
    if (!condition) continue;
    const Tensor axes = axes_of(condition->axes(), mesh.face_normal[f]);
    std::vector<Direction> at_face;
    for (int k = 0; k < dimension; ++k) {
      if (!condition->displacement_of(k)) continue;
      at_face.push_back({mesh.face_side[f], k, axes.col(k), {{f, k, 1.0}}});
      const double length = mesh.face_measure[f];
      for (const int node : mesh.face_nodes[f])
        add(at_nodes[node], mesh.face_side[f], k, length * axes.col(k), {f, k, length});
      for (const int edge : edges_of_face(raw, f))
        add(at_edges[edge], mesh.face_side[f], k, length * axes.col(k), {f, k, length});
    }
    held.faces[f] = combined(at_face);
  }
  for (const auto& [name, point] : options.pinned) {
    std::vector<Direction> pinned;
    const int node = pinned_node(point, name, mesh);
    for (int k = 0; k < dimension; ++k)
      if (point.displacement_along[k]) pinned.push_back({none, k, Point::Unit(k), {{none, k, 1.0, &point}}});
    at_nodes[node].insert(at_nodes[node].begin(), pinned.begin(), pinned.end());
  }
  for (const auto& directions : at_nodes) held.nodes.push_back(combined(directions));
  for (const auto& directions : at_edges) held.edges.push_back(combined(directions));
  return held;
}

}  // namespace sprekk::poromechanics
