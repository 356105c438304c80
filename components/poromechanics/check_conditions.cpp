#include "components/poromechanics/check_conditions.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace sprekk::poromechanics {
namespace {

void check_sides(const Options& options, const Mesh& mesh) {
  for (const auto& [side, condition] : options.boundary)
    if (std::find(mesh.side_names.begin(), mesh.side_names.end(), side) == mesh.side_names.end())
      throw unknown_name(condition.origin, "side of the boundary", side, mesh.side_names);
}

void check_held(const Options& options, const Mesh& mesh, const Origin& where) {
  // How prescribed displacements resist the rigid motions: along x, along y, and turning about the middle of the rock.
  Point middle = Point::Zero();
  for (const Point& center : mesh.cell_center) middle += center / mesh.cell_count();
  double size = 0;
  for (const Point& center : mesh.face_center) size = std::max(size, (center - middle).norm());
  Eigen::Matrix3d resistance = Eigen::Matrix3d::Zero();
  for (int f = 0; f < mesh.face_count(); ++f) {
    const SideCondition* condition = condition_of(options, mesh, f);
    if (!condition) continue;
    const Point arm = (mesh.face_center[f] - middle) / size;
    const Eigen::Vector3d motion[2] = {{1, 0, -arm[1]}, {0, 1, arm[0]}};
    for (int k = 0; k < 2; ++k)
      if (condition->displacement_of(k)) resistance += motion[k] * motion[k].transpose();
  }
  const std::string add =
      "add for example 'left: {displacement_x: 0 m}' and 'bottom: {displacement_y: 0 m}' to 'boundary:'";
  for (int k = 0; k < 2; ++k)
    if (resistance(k, k) == 0)
      throw InputError(where, std::string("nothing holds the rock along ") + "xy"[k],
                       std::string("no side has a displacement in ") + "xy"[k] + ", so that it may move freely", add);
  const Eigen::Vector3d eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(resistance).eigenvalues();
  constexpr double round_off = 1e-10;
  if (eigenvalues[0] <= round_off * eigenvalues[2])
    throw InputError(where, "nothing keeps the rock from turning",
                     "the displacements of its sides allow a small rotation about a point", add);
}

}  // namespace

const SideCondition* condition_of(const Options& options, const Mesh& mesh, int face) {
  if (mesh.face_cells[face][1] != none || mesh.face_side[face] == none) return nullptr;
  const auto found = options.boundary.find(mesh.side_names[mesh.face_side[face]]);
  return found == options.boundary.end() ? nullptr : &found->second;
}

void check_conditions(const Options& options, const Mesh& mesh, const Origin& where) {
  check_sides(options, mesh);
  check_held(options, mesh, where);
}

}  // namespace sprekk::poromechanics
