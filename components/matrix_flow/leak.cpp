// Fluid that leaks through sides of the rock.
#include <cmath>

#include "components/matrix_flow/buoyancy.hpp"
#include "components/matrix_flow/leaky_sides.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/matrix_of.hpp"

namespace sprekk::matrix_flow {

void MatrixFlow::open_leaky_sides(const ComponentContext& context) {
  auto sides = std::make_unique<LeakySides>(mesh_, options_.boundary, inside_);
  if (sides->is_empty()) return;
  leaky_sides_ = std::move(sides);
  side_outflow_ = &context.fields.add(mesh_, {.owner = context.name,
                                              .name = "side_outflow",
                                              .location = Location::face,
                                              .role = Role::unknown(BlockKind::interface),
                                              .unit = "m/s",
                                              .doc = "Flux out of the rock through leaky sides"});
  borders_.push_back({side_outflow_, 1, leaky_sides_->faces(), {}, {}, {}, {}});
}

LinearExpression MatrixFlow::side_pressure() const {
  LinearExpression pressure = border_pressure(*side_outflow_);
  if (buoyancy_) buoyancy_->add_to_sides(pressure, leaky_sides_->faces());
  return pressure;
}

void MatrixFlow::assemble_leak(Assembly& assembly, BalanceRows& fluid, double dt) const {
  const LinearExpression trace = side_pressure();
  const LeakySides::Correction correction = leaky_sides_->correction(*side_outflow_, trace);
  std::vector<Triplet> entries;
  for (const auto& [face, cell] : outer_faces_)
    if (leaky_sides_->faces()[face]) entries.emplace_back(cell, face, dt * mesh_.face_measure[face]);
  const SparseMatrix into_cells = matrix_of(mesh_.cell_count(), mesh_.face_count(), entries);
  const Vector amounts = into_cells * correction.value;
  fluid.exchange(amounts, amounts,
                 (into_cells * correction.of_trace).lpNorm<Eigen::Infinity>() * leaky_sides_->largest_pressure());
  if (!assembly.wants_derivatives()) return;
  const Vector by_flux = -correction.of_flux;
  assembly.derivative(pressure_, *side_outflow_, SparseMatrix(into_cells * by_flux.asDiagonal()));
  const SparseMatrix by_trace = into_cells * correction.of_trace.asDiagonal();
  for (const LinearExpression::Term& term : trace.terms)
    assembly.derivative(pressure_, *term.field, SparseMatrix(by_trace * term.matrix.entries()));
}

void MatrixFlow::correct_leak(Vector& fluxes) const {
  const LeakySides::Correction correction = leaky_sides_->correction(*side_outflow_, side_pressure());
  for (int f = 0; f < mesh_.face_count(); ++f) fluxes[f] += mesh_.face_measure[f] * correction.value[f];
}

std::uint64_t MatrixFlow::discrete_state() const {
  const bool has_states = side_outflow_ && leaky_sides_->let_only_out() && is_discretized() && boundary_applied_;
  return has_states ? leaky_sides_->passing_state(*side_outflow_, side_pressure()) : 0;
}

Vector MatrixFlow::leaking() const {
  Vector amounts = Vector::Zero(mesh_.cell_count());
  for (const auto& [face, cell] : outer_faces_)
    if (leaky_sides_->faces()[face]) amounts[cell] += mesh_.face_measure[face] * std::abs(side_outflow_->now()[face]);
  return amounts;
}

}  // namespace sprekk::matrix_flow
