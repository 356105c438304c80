// The pressures of faces, where they are unknowns: start values, matrices and equations.
#include <algorithm>

#include "components/matrix_flow/buoyancy.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {

void MatrixFlow::start_face_pressure() {
  Vector values(mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) {
    const auto [cell, other] = mesh_.face_cells[f];
    const auto potential = [&](int c) { return pressure_.now()[c] - gravity_potential_cell_[c]; };
    values[f] = gravity_potential_face_[f];
    if (other == none) {
      values[f] += potential(cell);
      continue;
    }
    // Between two points, with the flux normal to the face.
    const auto conductance = [&](int c) {
      const Point& normal = mesh_.face_normal[f];
      return normal.dot(mobility_[c] * normal) / std::abs(normal.dot(mesh_.face_center[f] - mesh_.cell_center[c]));
    };
    const bool flows = !is_sealed_ && is_in_cell(cell) && is_in_cell(other);
    const double one = flows ? conductance(cell) : 1, two = flows ? conductance(other) : 1;
    values[f] += potential(cell) + two / (one + two) * (potential(other) - potential(cell));
  }
  SPREKK_ASSERT(is_finite(values), name());
  face_pressure_->set_both(std::move(values));
}

void MatrixFlow::use_face_operators() {
  const FacePressureOperators& faces = operators_.faces;
  SPREKK_ASSERT(faces.continuity_face.rows() == mesh_.face_count(), faces.continuity_face.rows(), mesh_.face_count());
  SPREKK_ASSERT(is_finite(faces.continuity_face) && is_finite(faces.flux), name());
  continuity_of_pressure_ = Operator(SparseMatrix(faces.continuity_cell));
  continuity_of_face_pressure_ = Operator(SparseMatrix(faces.continuity_face));
  largest_face_conductance_ = 0;
  for (int f = 0; f < mesh_.face_count(); ++f)
    largest_face_conductance_ = std::max(largest_face_conductance_, faces.continuity_face.row(f).cwiseAbs().sum() +
                                                                        faces.continuity_cell.row(f).cwiseAbs().sum());
  if (wall_flux_) continuity_of_wall_flux_ = Operator(SparseMatrix(faces.continuity_boundary * boundary_of_wall_flux_));
}

void MatrixFlow::assemble_face_pressure(Assembly& assembly, const StepTime& step) const {
  const Field& face_pressure = *face_pressure_;
  SPREKK_EXPECT(is_discretized() && boundary_applied_, name());
  // As in the balances of cells: the sum is small against the fluxes, and not against single terms of the pressure.
  Vector sums = operators_.faces.continuity_cell * (pressure_.now() - gravity_potential_cell_) +
                operators_.faces.continuity_face * (face_pressure.now() - gravity_potential_face_) +
                continuity_constant_;
  if (buoyancy_)
    sums += buoyancy_->continuity().cells * buoyancy_->excess(FluidDensity::State::now) +
            buoyancy_->continuity().of_boundaries;
  assembly.add(face_pressure, step.dt * sums);
  assembly.derivative(face_pressure, pressure_, continuity_of_pressure_, step.dt);
  assembly.derivative(face_pressure, face_pressure, continuity_of_face_pressure_, step.dt);
  if (wall_flux_) assembly.linear(face_pressure, continuity_of_wall_flux_, *wall_flux_, step.dt);
  for (const OpenBorder& border : borders_) assembly.linear(face_pressure, border.continuity, *border.outflow, step.dt);
  if (buoyancy_) assemble_density_on_faces(assembly, step.dt);
  assembly.compare_with(face_pressure, step.dt * face_fluxes().lpNorm<Eigen::Infinity>());
  assembly.compare_with(face_pressure, step.dt * flow(State::accepted).largest_outflow);
  const double largest_pressure =
      std::max(pressure_.now().lpNorm<Eigen::Infinity>(), face_pressure.now().lpNorm<Eigen::Infinity>());
  assembly.compare_round_off(face_pressure, step.dt * largest_face_conductance_ * largest_pressure);
}

}  // namespace sprekk::matrix_flow
