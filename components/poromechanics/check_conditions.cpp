#include "components/poromechanics/check_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "framework/dense/symmetric_eigen.hpp"
#include "framework/discretization/principal_axes.hpp"
#include "framework/field/field.hpp"
#include "framework/linear/rigid_rotations.hpp"
#include "framework/round_off.hpp"

namespace sprekk::poromechanics {
namespace {

void check_sides(const Options& options, const Mesh& mesh) {
  for (const auto& [side, condition] : options.boundary)
    if (std::find(mesh.side_names.begin(), mesh.side_names.end(), side) == mesh.side_names.end())
      throw unknown_name(condition.origin, "side of the boundary", side, mesh.side_names);
}

/// "x", "y", or the components of a unit vector.
std::string direction_text(Point direction) {
  for (int k = 0; k < dimension; ++k)
    if ((direction - direction[k] * Point::Unit(k)).squaredNorm() <= rounding::same) return axis_names[k];
  if (direction.x() < 0) direction = -direction;
  std::string text;
  for (const double component : direction) text += fmt::format("{}{:.3g}", text.empty() ? "(" : ", ", component);
  return text + ")";
}

/// Pinned points of one node that are held in the same direction, and on sides that are.
void check_pinned(const Options& options, const Mesh& mesh) {
  std::map<std::pair<int, int>, std::string> held;  // by node and axis
  for (const auto& [name, point] : options.pinned)
    for (int k = 0; k < dimension; ++k) {
      if (!point.displacement_along[k]) continue;
      const auto [other, is_first] = held.try_emplace({pinned_node(point, name, mesh), k}, name);
      if (!is_first)
        throw InputError(point.origin,
                         fmt::format("the displacement in {} of the pinned points '{}' and '{}' is given twice",
                                     axis_names[k], other->second, name),
                         "one node of the mesh is nearest to both", "remove one of them, or refine the mesh there");
    }
  for (const auto& [name, point] : options.pinned)
    for (const int face : mesh.node_faces[pinned_node(point, name, mesh)]) {
      const SideCondition* condition = condition_of(options, mesh, face);
      if (!condition) continue;
      const Tensor axes = axes_of(condition->axes(), mesh.face_normal[face]);
      for (int k = 0; k < dimension; ++k)
        for (int j = 0; j < dimension; ++j)
          if (point.displacement_along[k] && condition->displacement_of(j) && axes(k, j) * axes(k, j) > rounding::same)
            throw InputError(point.origin,
                             "the displacement in " + std::string(axis_names[k]) + " of the pinned point '" + name +
                                 "' is given twice",
                             "it lies on side '" + mesh.side_names[mesh.face_side[face]] + "', which is held",
                             "remove one of the two");
    }
}

/// Where prescribed displacements hold a face: at its nodes, or by its mean.
std::vector<Point> held_points(const Mesh& mesh, int face, Location displaced) {
  if (displaced != Location::node) return {mesh.face_center[face]};
  std::vector<Point> points;
  for (const int node : mesh.face_nodes[face]) points.push_back(mesh.nodes[node]);
  return points;
}

void check_held(const Options& options, const Mesh& mesh, Location displaced, const Origin& where) {
  // How prescribed displacements resist the rigid motions: along the axes, and turning about the middle of the rock.
  Point middle = Point::Zero();
  for (const Point& center : mesh.cell_center) middle += center / mesh.cell_count();
  double size = 0;
  for (const Point& center : mesh.face_center) size = std::max(size, (center - middle).norm());
  constexpr int motions = dimension + rigid_rotations(dimension);
  Eigen::MatrixXd resistance = Eigen::MatrixXd::Zero(motions, motions);
  const auto resist = [&](const Point& arm, const Point& direction) {
    Eigen::VectorXd motion(motions);
    motion << direction, rotated(arm).transpose() * direction;
    resistance += motion * motion.transpose();
  };
  for (int f = 0; f < mesh.face_count(); ++f) {
    const SideCondition* condition = condition_of(options, mesh, f);
    if (!condition) continue;
    const Tensor axes = axes_of(condition->axes(), mesh.face_normal[f]);
    Tensor spring = Tensor::Zero();
    if (condition->has_spring())
      spring =
          condition->spring_at({mesh.face_center[f], mesh.cell_region[mesh.face_cells[f][0]], 0}, mesh.face_normal[f]);
    const Tensor along = axes_of(ConditionAxes::of_face, mesh.face_normal[f]);
    for (const Point& point : held_points(mesh, f, displaced)) {
      const Point arm = (point - middle) / size;
      for (int k = 0; k < dimension; ++k) {
        if (condition->displacement_of(k)) resist(arm, axes.col(k));
        if (along.col(k).dot(spring * along.col(k)) > 0) resist(arm, along.col(k));
      }
    }
  }
  for (const auto& [name, point] : options.pinned) {
    const Point arm = (mesh.nodes[pinned_node(point, name, mesh)] - middle) / size;
    for (int k = 0; k < dimension; ++k)
      if (point.displacement_along[k]) resist(arm, Point::Unit(k));
  }
  const std::string add =
      dimension == 2 ? "add for example 'left: {displacement_x: 0 m}' and 'bottom: {displacement_y: 0 m}' to "
                       "'boundary:', or 'displacement_normal: 0 m' to two sides that are not parallel, or "
                       "points to 'pinned:'"
                     : "add for example 'left: {displacement_x: 0 m}', 'front: {displacement_y: 0 m}' and 'bottom: "
                       "{displacement_z: 0 m}' to 'boundary:', or 'displacement_normal: 0 m' to three sides that are "
                       "not parallel, or points to 'pinned:'";
  const PrincipalAxes shifts = principal_axes(resistance.topLeftCorner<dimension, dimension>());
  if (shifts.values[0] <= rounding::same * shifts.values[dimension - 1]) {
    const std::string free = direction_text(shifts.axes.col(0));
    throw InputError(where, "nothing holds the rock along " + free,
                     "no side has a displacement in " + free + ", so that it may move freely", add);
  }
  const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(resistance);
  if (eigenvalues[0] <= rounding::same * eigenvalues[motions - 1])
    throw InputError(where, "nothing keeps the rock from turning",
                     "the displacements of its sides allow a small rotation about a point", add);
}

}  // namespace

const SideCondition* condition_of(const Options& options, const Mesh& mesh, int face) {
  if (mesh.face_cells[face][1] != none || mesh.face_side[face] == none) return nullptr;
  const auto found = options.boundary.find(mesh.side_names[mesh.face_side[face]]);
  return found == options.boundary.end() ? nullptr : &found->second;
}

void check_conditions(const Options& options, const Mesh& mesh, Location displaced, const Origin& where) {
  check_sides(options, mesh);
  check_pinned(options, mesh);
  check_held(options, mesh, displaced, where);
}

}  // namespace sprekk::poromechanics
