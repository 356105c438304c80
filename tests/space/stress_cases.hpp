// What the operators of a discretization of the stress make of exact values in cells and on the boundary.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "components/poromechanics/mpsa/mpsa.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::test {

using poromechanics::ConditionAxes;
using poromechanics::FaceConditions;
using poromechanics::MechanicalCondition;
using poromechanics::Stiffness;
using poromechanics::StressOperators;

/// Tractions on all faces with one cell.
inline std::vector<FaceConditions> given_tractions(const Mesh& mesh) {
  std::vector<FaceConditions> conditions(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f)
    if (mesh.face_cells[f][1] == none) conditions[f].along.fill(MechanicalCondition::traction);
  return conditions;
}

/// All kinds in turn on sides, some along the axes of faces; tractions on walls.
inline std::vector<FaceConditions> all_kinds_of_conditions(const Mesh& mesh) {
  std::vector<FaceConditions> conditions = given_tractions(mesh);
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face_side[f] == none) continue;
    for (int c = 0; c < dimension; ++c)
      if ((f >> c) % 2 == 0) conditions[f][c] = MechanicalCondition::displacement;
    if (f % 3 == 0) conditions[f].axes = ConditionAxes::of_face;
  }
  return conditions;
}

/// Rollers on all sides but the last, which is loaded.
inline std::vector<FaceConditions> rollers(const Mesh& mesh) {
  std::vector<FaceConditions> conditions = given_tractions(mesh);
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face_side[f] == none) continue;
    conditions[f].axes = ConditionAxes::of_face;
    if (mesh.face_side[f] < 5) conditions[f][0] = MechanicalCondition::displacement;
  }
  return conditions;
}

/// A displacement (m), its gradient and the isotropic stress of cells (Pa).
struct ExactStress {
  std::function<Point(const Point&)> displacement;
  std::function<Tensor(int)> gradient;
  std::function<double(int)> isotropic;
};

/// sigma·n on a side of a face, times its measure (N), n out of its first cell.
inline Point force_on(const Mesh& mesh, const std::vector<Stiffness>& stiffness, const ExactStress& exact, int face,
                      int side) {
  const int cell = mesh.face_cells[face][side];
  const SymmetricTensor of_cell = stiffness[cell] * poromechanics::strain_of(exact.gradient(cell));
  Tensor stress = -exact.isotropic(cell) * Tensor::Identity();
  for (int k = 0; k < symmetric_components; ++k) {
    const auto [i, j] = symmetric_axes[k];
    stress(i, j) += of_cell[k];
    if (i != j) stress(j, i) += of_cell[k];
  }
  return mesh.face_measure[face] * stress * mesh.face_normal[face];
}

/// The boundary values of StressOperators.
inline Vector given_values(const Mesh& mesh, const std::vector<Stiffness>& stiffness,
                           const std::vector<FaceConditions>& conditions, const ExactStress& exact) {
  Vector b = Vector::Zero(dimension * mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Tensor axes = poromechanics::axes_of(conditions[f].axes, mesh.face_normal[f]);
    for (int c = 0; c < dimension; ++c) {
      double& value = b[dimension * f + c];
      if (conditions[f][c] == MechanicalCondition::displacement)
        value = axes.col(c).dot(exact.displacement(mesh.face_center[f]));
      if (conditions[f][c] == MechanicalCondition::traction)
        value = axes.col(c).dot(force_on(mesh, stiffness, exact, f, 0));
      if (conditions[f][c] == MechanicalCondition::load)
        value = (force_on(mesh, stiffness, exact, f, 0) - force_on(mesh, stiffness, exact, f, 1))[c];
    }
  }
  return b;
}

/// Largest errors of forces (N), displacements of faces (m) and changes of volume (m^3).
struct StressErrors {
  double force = 0, trace = 0, volume = 0;
};

inline StressErrors errors_of(const StressOperators& operators, const Mesh& mesh,
                              const std::vector<Stiffness>& stiffness, const std::vector<FaceConditions>& conditions,
                              const ExactStress& exact) {
  Vector u(dimension * mesh.cell_count()), s(mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c) {
    u.segment<dimension>(dimension * c) = exact.displacement(mesh.cell_center[c]);
    s[c] = exact.isotropic(c);
  }
  const Vector b = given_values(mesh, stiffness, conditions, exact);
  const Vector forces = operators.force_displacement * u + operators.force_stress * s + operators.force_boundary * b;
  const Vector traces = operators.trace_displacement * u + operators.trace_stress * s + operators.trace_boundary * b;
  const Vector volumes =
      operators.volume_displacement * u + operators.volume_stress * s + operators.volume_boundary * b;
  StressErrors errors;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Point force = forces.segment<dimension>(dimension * f) - force_on(mesh, stiffness, exact, f, 0);
    errors.force = std::max(errors.force, force.norm());
    if (mesh.face_cells[f][1] != none) continue;
    const Point trace = traces.segment<dimension>(dimension * f) - exact.displacement(mesh.face_center[f]);
    errors.trace = std::max(errors.trace, trace.norm());
  }
  for (int c = 0; c < mesh.cell_count(); ++c)
    errors.volume = std::max(errors.volume, std::abs(volumes[c] - mesh.cell_measure[c] * exact.gradient(c).trace()));
  return errors;
}

/// Positive definite; shears and normal components are coupled.
inline Stiffness some_stiffness() {
  Stiffness root;
  root << 1.5, 0.3, 0.2, 0.1, -0.2, 0.1,  //
      0.2, 1.1, 0.4, -0.1, 0.1, 0.2,      //
      0.5, 0.1, 1.9, 0.3, 0.2, -0.3,      //
      0, 0.2, -0.1, 0.8, 0.1, 0.1,        //
      0.1, -0.2, 0.1, 0, 0.7, 0.2,        //
      -0.1, 0.1, 0.2, 0.1, 0, 0.9;
  return root * root.transpose();
}

}  // namespace sprekk::test
