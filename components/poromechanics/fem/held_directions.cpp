#include "components/poromechanics/fem/held_directions.hpp"

#include <Eigen/LU>
#include <cmath>

#include "components/poromechanics/check_conditions.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk::poromechanics {

namespace {

/// A direction that is held; its length is the measure of the boundary that holds it.
struct Direction {
  int side, axis;  ///< of the boundary, and the direction of its condition
  Point vector;
  std::vector<HeldBy> by;
};

constexpr double same_side = 0.5;  // sine of the angle between faces of one curved side; more is a corner
constexpr double parallel = 1e-3;  // sine of the angle between directions that hold as one

double sine(const Point& a, const Point& b) { return std::abs(cross(a, b)) / (a.norm() * b.norm()); }

void add(std::vector<Direction>& directions, int side, int axis, const Point& vector, const HeldBy& by) {
  for (Direction& direction : directions) {
    const bool is_same = direction.side == side && direction.axis == axis;
    if (sine(direction.vector, vector) > (is_same ? same_side : parallel)) continue;
    const double sign = direction.vector.dot(vector) < 0 ? -1 : 1;
    direction.vector += sign * vector;
    direction.by.push_back({by.face, by.axis, sign * by.share});
    return;
  }
  directions.push_back({side, axis, vector, {by}});
}

/// Two directions at most determine a displacement.
HeldDirections combined(const std::vector<Direction>& directions) {
  HeldDirections held;
  if (directions.empty()) return held;
  const Point first = directions[0].vector.normalized();
  if (directions.size() == 1) {
    const int slot = std::abs(first[0]) >= std::abs(first[1]) ? 0 : 1;
    held.axes.col(slot) = first;
    held.axes.col(1 - slot) = Point(-first[1], first[0]);
    held.is_held[slot] = true;
    for (const HeldBy& by : directions[0].by)
      held.by[slot].push_back({by.face, by.axis, by.share / directions[0].vector.norm()});
    return held;
  }
  // The columns of the inverse give (x, y) from the displacements along both.
  Tensor both;
  both << directions[0].vector.transpose(), directions[1].vector.transpose();
  const Tensor inverse = both.inverse();
  for (int k = 0; k < dimension; ++k) {
    held.is_held[k] = true;
    for (int i = 0; i < 2; ++i)
      for (const HeldBy& by : directions[i].by) held.by[k].push_back({by.face, by.axis, inverse(k, i) * by.share});
  }
  return held;
}

}  // namespace

Held held_directions(const Options& options, const Mesh& mesh) {
  std::vector<std::vector<Direction>> at_nodes(mesh.node_count());
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
    }
    held.faces[f] = combined(at_face);
  }
  for (const auto& directions : at_nodes) held.nodes.push_back(combined(directions));
  return held;
}

}  // namespace sprekk::poromechanics
