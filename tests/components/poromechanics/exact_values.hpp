// What the operators of MPSA make of exact values in the cells and on the boundary.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "components/poromechanics/mpsa/mpsa.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::test {

using poromechanics::ConditionAxes;
using poromechanics::FaceConditions;
using poromechanics::MechanicalCondition;
using poromechanics::Stiffness;

/// Both directions prescribed, either one, and none, in turn; walls have prescribed tractions.
inline std::vector<FaceConditions> mixed_conditions(const Mesh& mesh) {
  const auto kind = [](bool moves) {
    return moves ? MechanicalCondition::displacement : MechanicalCondition::traction;
  };
  std::vector<FaceConditions> conditions(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f)
    if (is_outer(mesh, f)) {
      const bool is_wall = test::is_wall(mesh, f);
      conditions[f] = {kind(!is_wall && f % 2 == 0), kind(!is_wall && f / 2 % 2 == 0)};
    }
  return conditions;
}

inline std::vector<FaceConditions> traction_everywhere(const Mesh& mesh) {
  std::vector<FaceConditions> conditions(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f)
    if (is_outer(mesh, f)) conditions[f] = {MechanicalCondition::traction, MechanicalCondition::traction};
  return conditions;
}

/// What the operators make of exact values in the cells and on the boundary, against the exact result.
struct Comparison {
  double force = 0, trace = 0, volume = 0;  ///< largest errors
};

/// `displacement` and, for the cell c, its gradient and stress s; force = (C : gradient - s I) n |f|.
inline Comparison compare(const Mesh& mesh, const std::vector<Stiffness>& stiffness,
                          const std::vector<FaceConditions>& conditions,
                          const std::function<Point(const Point&)>& displacement,
                          const std::function<Tensor(int)>& gradient,
                          const std::function<double(int)>& isotropic_stress) {
  const auto operators = poromechanics::discretize_mpsa(mesh, stiffness, conditions);
  const auto force_of = [&](int f, int c) -> Point {
    const Tensor g = gradient(c);
    const Eigen::Vector3d sigma = stiffness[c] * Eigen::Vector3d(g(0, 0), g(1, 1), g(0, 1) + g(1, 0));
    const Point n = test::face_vector(mesh, f);
    return {sigma[0] * n[0] + sigma[2] * n[1] - isotropic_stress(c) * n[0],
            sigma[2] * n[0] + sigma[1] * n[1] - isotropic_stress(c) * n[1]};
  };
  const auto force = [&](int f) { return force_of(f, mesh.face_cells[f][0]); };
  Vector u(2 * mesh.cell_count()), s(mesh.cell_count()), b = Vector::Zero(2 * mesh.face_count());
  for (int c = 0; c < mesh.cell_count(); ++c) {
    u.segment<2>(2 * c) = displacement(mesh.cell_center[c]);
    s[c] = isotropic_stress(c);
  }
  for (int f = 0; f < mesh.face_count(); ++f)
    for (int d = 0; d < 2; ++d) {
      const Point axis = poromechanics::axes_of(conditions[f].axes, mesh.face_normal[f]).col(d);
      if (conditions[f][d] == MechanicalCondition::displacement)
        b[2 * f + d] = axis.dot(displacement(mesh.face_center[f]));
      if (conditions[f][d] == MechanicalCondition::traction) b[2 * f + d] = axis.dot(force(f));
      if (conditions[f][d] == MechanicalCondition::load)
        b[2 * f + d] = force(f)[d] - force_of(f, mesh.face_cells[f][1])[d];
    }
  const Vector forces = operators.force_displacement * u + operators.force_stress * s + operators.force_boundary * b;
  const Vector traces = operators.trace_displacement * u + operators.trace_stress * s + operators.trace_boundary * b;
  const Vector volumes =
      operators.volume_displacement * u + operators.volume_stress * s + operators.volume_boundary * b;
  Comparison errors;
  for (int f = 0; f < mesh.face_count(); ++f) {
    errors.force = std::max(errors.force, (forces.segment<2>(2 * f) - force(f)).norm());
    const Point trace = is_outer(mesh, f) ? displacement(mesh.face_center[f]) : Point::Zero().eval();
    errors.trace = std::max(errors.trace, (traces.segment<2>(2 * f) - trace).norm());
  }
  for (int c = 0; c < mesh.cell_count(); ++c)
    errors.volume = std::max(errors.volume, std::abs(volumes[c] - mesh.cell_measure[c] * gradient(c).trace()));
  return errors;
}

/// Shear and normal components coupled.
inline Stiffness anisotropic_stiffness() {
  Stiffness stiffness;
  stiffness << 5, 1.5, 0.8, 1.5, 3, -0.6, 0.8, -0.6, 1.2;
  return stiffness;
}

inline const Tensor linear_gradient = (Tensor() << 0.7, -1.1, 0.4, 0.9).finished();
inline Point linear_displacement(const Point& x) { return Point(0.3, -0.2) + linear_gradient * x; }

/// A rotation.
inline Tensor turned_by(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return (Tensor() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
}
inline const Tensor mirrored = (Tensor() << -1, 0, 0, 1).finished();

/// The same cells elsewhere: x becomes map · x.
inline Mesh moved(const Mesh& mesh, const Tensor& map) {
  RawMesh raw = to_raw_mesh(mesh);
  for (Point& node : raw.nodes) node = map * node;
  return build_mesh(raw);
}

}  // namespace sprekk::test
