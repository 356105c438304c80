// Forces, stress and displacements of sides that follow from the state of the rock.
#include <Eigen/LU>
#include <limits>
#include <vector>

#include "components/poromechanics/notes.hpp"
#include "components/poromechanics/principal_stress.hpp"
#include "components/poromechanics/rock.hpp"
#include "components/poromechanics/stress_without_displacement.hpp"
#include "framework/field/ownership.hpp"

namespace sprekk::poromechanics {

Vector Rock::face_forces() const {
  Vector values = boundary_values_;
  if (wall_traction_) values += wall_forces_ * wall_load();
  Vector forces = operators_.force_displacement * displacement_.now() + operators_.force_boundary * values;
  for (const PoreLoad& load : loads_) forces += operators_.force_stress * load.stress();
  for (int f = 0; f < mesh_.face_count(); ++f)
    forces.segment<dimension>(dimension * f) += mesh_.face_measure[f] * initial_traction(f, 0);
  return forces;
}

std::string Rock::flaw_of_jumps() const {
  if (dimension == 2) return {};
  return "the field around rims is not part of this discretization in space: factors are up to a third too large with "
         "4 cells behind a front, and a tenth with 8";
}

Vector Rock::outer_displacement() const {
  Vector values = boundary_values_;
  if (wall_traction_) values += wall_forces_ * wall_load();
  Vector displacement = operators_.trace_displacement * displacement_.now() + operators_.trace_boundary * values;
  for (const PoreLoad& load : loads_) displacement += operators_.trace_stress * load.stress();
  exchange(mesh_, Location::face, dimension, displacement);
  return displacement;
}

namespace {

/// The arms of the faces of a cell over its volume, so that sum of (area vector) ⊗ arm is the unit tensor: in space
/// also where faces are bent, whose centres alone do not give it.
std::vector<Point> arms_over_volume(const Mesh& mesh, int cell) {
  std::vector<Point> arms;
  for (const int face : mesh.cell_faces[cell]) arms.emplace_back(mesh.face_center[face] - mesh.cell_center[cell]);
  if constexpr (dimension == 2) {
    for (Point& arm : arms) arm /= mesh.cell_measure[cell];
  } else {
    Tensor sum = Tensor::Zero();
    for (std::size_t k = 0; const int face : mesh.cell_faces[cell])
      sum += (mesh.face_cells[face][0] == cell ? 1 : -1) * mesh.face_measure[face] * mesh.face_normal[face] *
             arms[k++].transpose();
    const Tensor inverse = sum.inverse();
    for (Point& arm : arms) arm = inverse.transpose() * arm;
  }
  return arms;
}

}  // namespace

Vector Rock::stress_of(const Vector& forces, const Vector& moments) const {
  // The stress of a cell from the forces on its faces: V sigma = sum of force ⊗ (x_face − x_cell), exact when constant,
  // and near tips of cracks with the moments of the singular tractions about the centres of the faces.
  Vector stress = Vector::Zero(symmetric_components * mesh_.cell_count());
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    const std::vector<Point> arms = arms_over_volume(mesh_, c);
    for (std::size_t at = 0; const int face : mesh_.cell_faces[c]) {
      const double sign = mesh_.face_cells[face][0] == c ? 1 : -1;
      const Point force = sign * forces.segment<dimension>(dimension * face);
      const Point& arm = arms[at++];
      SymmetricTensor of_force;
      for (int k = 0; k < symmetric_components; ++k) {
        const auto [i, j] = symmetric_axes[k];
        of_force[k] = i == j ? force[i] * arm[i] : 0.5 * (force[i] * arm[j] + force[j] * arm[i]);
      }
      stress.segment<symmetric_components>(symmetric_components * c) +=
          of_force + sign / mesh_.cell_measure[c] * moments.segment<symmetric_components>(symmetric_components * face);
    }
  }
  return stress;
}

Vector Rock::mean_stress() const {
  if (discretizations_ == 0 || (!settled_ && displacement_.now().isZero(0)))
    return stress_without_displacement(mesh_, options_, pore_stress());
  Vector stress = stress_of(face_forces(), operators_.moment_displacement * displacement_.now());
  if (settled_) {
    const Vector of_moments =
        settled_->stress - stress_of(settled_->forces, Vector::Zero(symmetric_components * mesh_.face_count()));
    for (int c = 0; c < mesh_.cell_count(); ++c)
      stress.segment<symmetric_components>(symmetric_components * c) +=
          stiffness_.excavation().support(c) * of_moments.segment<symmetric_components>(symmetric_components * c);
  }
  exchange(mesh_, Location::cell, symmetric_components, stress);
  return stress;
}

void Rock::note_step(Notes& notes, const StepTime&) const {
  // The relative displacement of neighbours over their distance: the displacement gradient along it.
  LargestStrain largest;
  const Vector& u = displacement_.now();
  for (int f = 0; f < mesh_.face_count(); ++f) {
    const auto& [first, second] = mesh_.face_cells[f];
    if (second == none) continue;
    if (stiffness_.excavation().is_removed(first) || stiffness_.excavation().is_removed(second)) continue;
    const double distance = (mesh_.cell_center[second] - mesh_.cell_center[first]).norm();
    const double strain =
        (u.segment<dimension>(dimension * second) - u.segment<dimension>(dimension * first)).norm() / distance;
    if (strain > largest.strain) largest = {strain, mesh_.face_center[f]};
  }
  note_large_strain(notes, name(), largest, options_, stiffness_.of_cells());
}

double Rock::largest_load() const {
  double largest = 0;
  const double unknown = std::numeric_limits<double>::infinity();
  for (int f = 0; f < mesh_.face_count(); ++f) {
    const Point initial = axes_of(conditions_[f].axes, mesh_.face_normal[f]).transpose() *
                          Point(initial_forces_.segment<dimension>(dimension * f));
    Point total = boundary_values_.segment<dimension>(dimension * f) + initial;
    for (int k = 0; k < dimension; ++k) {
      if (conditions_[f][k] != MechanicalCondition::displacement) continue;
      if (boundary_values_[dimension * f + k] != 0) return unknown;
      total[k] = 0;
    }
    largest = std::max(largest, initial.norm() / mesh_.face_measure[f]);
    if (mesh_.face_cells[f][1] == none) largest = std::max(largest, total.norm() / mesh_.face_measure[f]);
  }
  return body_forces_.isZero(0) ? largest : unknown;
}

}  // namespace sprekk::poromechanics
