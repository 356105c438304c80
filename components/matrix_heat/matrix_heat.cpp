#include "components/matrix_heat/matrix_heat.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "components/capabilities/cold.hpp"
#include "components/capabilities/overshoots.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/property.hpp"
#include "framework/discretization/changes_along_face.hpp"
#include "framework/field/counted_amounts.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_mean.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::matrix_heat {

MatrixHeat::MatrixHeat(const ComponentContext& context, const Options& options, DiscretizeFlux discretize)
    : Component(context.name),
      mesh_(context.mesh),
      options_(options),
      origin_(context.origin),
      discretize_(discretize),
      temperature_(context.fields.add(mesh_, {.owner = context.name,
                                              .name = "temperature",
                                              .location = Location::cell,
                                              .role = Role::unknown(BlockKind::bulk_elliptic),
                                              .unit = "K",
                                              .doc = "Temperature of the matrix"})),
      cumulative_(context.fields.add(
          mesh_, amounts_with(temperature_, context.name, "cumulative_heat", energy_unit,
                              "Heat stored, generated, and conducted out through the boundary", 3))) {
  if (mesh_.wall_count() > 0)
    wall_heat_flux_ = &context.fields.add(mesh_, {.owner = context.name,
                                                  .name = "wall_heat_flux",
                                                  .location = Location::wall,
                                                  .role = Role::input(BlockKind::interface),
                                                  .unit = "W/m^2",
                                                  .doc = "Heat conducted from the fracture into the matrix"});
  check_sides();
  read_properties(context.start_time);
  temperature_.set_both(initial_temperature_);
}

void MatrixHeat::check_sides() const {
  for (const auto& [side, condition] : options_.boundary)
    if (std::find(mesh_.side_names.begin(), mesh_.side_names.end(), side) == mesh_.side_names.end())
      throw unknown_name(condition.origin, "side of the boundary", side, mesh_.side_names);
}

void MatrixHeat::read_properties(double start) {
  const std::vector<Place> places = cell_places(mesh_);
  initial_temperature_ = Property(options_.initial_temperature, places, start).values();
  capacity_ = Property(options_.heat_capacity, places, start).values();
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    capacity_[c] *= mesh_.cell_measure[c];
    conductivity_.push_back(options_.conductivity.at(places[c]));
    const Tensor& k = conductivity_.back();
    if (!(k.trace() > 0) || !(k.determinant() > 0))
      throw DataError(InputError(origin_, "the conductivity is not positive definite",
                                 "heat could not be conducted in one direction", "raise it in that direction")
                          .what());
  }
}

const SideCondition* MatrixHeat::condition(int face) const {
  if (mesh_.face_side[face] == none) return nullptr;
  const auto found = options_.boundary.find(mesh_.side_names[mesh_.face_side[face]]);
  return found == options_.boundary.end() ? nullptr : &found->second;
}

std::optional<double> MatrixHeat::side_temperature(int face) const {
  const SideCondition* side = condition(face);
  if (!side || !side->temperature) return std::nullopt;
  return boundary_values_[face];
}

void MatrixHeat::discretize() {
  if (is_discretized_ && discretized_mesh_ == mesh_.version) return;
  conditions_.assign(mesh_.face_count(), FlowCondition::none);
  for (int f = 0; f < mesh_.face_count(); ++f) {
    if (mesh_.face_cells[f][1] != none) continue;
    const SideCondition* side = condition(f);
    conditions_[f] = side && side->temperature ? FlowCondition::pressure : FlowCondition::flux;
  }
  FluxOperators made = discretize_(mesh_, conductivity_, conditions_, nodes_to_discretize(mesh_));
  operators_.swap(made);
  use_operators();
  is_discretized_ = true;
  discretized_mesh_ = mesh_.version;
}

void MatrixHeat::use_operators() {
  std::vector<char> is_outer(mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) is_outer[f] = mesh_.face_cells[f][1] == none;
  const int rank = parallel::rank();
  const auto outflow_of = [&](const SparseMatrix& fluxes) {
    return Operator(cell_sums(mesh_, fluxes, 1, rank), cell_sums(mesh_, keep_rows(fluxes, is_outer), 1, rank));
  };
  capacity_of_temperature_ = Operator(diagonal_matrix(capacity_));
  outflow_of_temperature_ = outflow_of(operators_.flux_cell);
  SPREKK_ASSERT(is_finite(operators_.flux_cell) && is_finite(operators_.flux_boundary));
  largest_conductance_ = 0;
  const SparseMatrix& outflow = outflow_of_temperature_.entries();
  for (int row = 0; row < outflow.rows(); ++row)
    largest_conductance_ = std::max(largest_conductance_, outflow.row(row).cwiseAbs().sum());
  if (!wall_heat_flux_) return;

  // The flux out of the rock through a wall is minus the flux into it, times its length.
  std::vector<Triplet> entries;
  for (int w = 0; w < mesh_.wall_count(); ++w)
    entries.emplace_back(mesh_.wall_face(w), w, -mesh_.face_measure[mesh_.wall_face(w)]);
  boundary_of_wall_flux_.resize(mesh_.face_count(), mesh_.wall_count());
  boundary_of_wall_flux_.setFromTriplets(entries.begin(), entries.end());
  flux_of_wall_flux_ = operators_.flux_boundary * boundary_of_wall_flux_;
  outflow_of_wall_flux_ = outflow_of(flux_of_wall_flux_);
  entries.clear();
  for (int w = 0; w < mesh_.wall_count(); ++w)
    if (is_owned(mesh_, Location::wall, w)) entries.emplace_back(w, mesh_.wall_face(w), 1.0);
  SparseMatrix pick_walls(mesh_.wall_count(), mesh_.face_count());
  pick_walls.setFromTriplets(entries.begin(), entries.end());
  wall_temperature_.terms = {
      {&temperature_, Operator(pick_walls * operators_.trace_cell)},
      {wall_heat_flux_, Operator(pick_walls * operators_.trace_boundary * boundary_of_wall_flux_)}};
}

void MatrixHeat::evaluate_data(const StepTime& step) {
  source_ = Vector::Zero(mesh_.cell_count());
  if (!options_.source.is_zero())
    for (int c = 0; c < mesh_.cell_count(); ++c)
      source_[c] = mesh_.cell_measure[c] * cell_mean(mesh_, c, [&](const Point& at) {
                     return value_in_step(options_.source, {at, mesh_.cell_region[c], 0}, step);
                   });
  boundary_values_ = Vector::Zero(mesh_.face_count());
  boundary_changes_ = Vector::Zero(directions_of_faces * mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) {
    const SideCondition* side = condition(f);
    if (!side) continue;
    const Place place{mesh_.face_center[f], mesh_.cell_region[mesh_.face_cells[f][0]], 0};
    if (side->heat_flux) boundary_values_[f] = value_in_step(*side->heat_flux, place, step) * mesh_.face_measure[f];
    if (!side->temperature) continue;
    const LinearOnFace linear = linear_on_face(mesh_, f, [&](const Point& x) {
      return value_in_step(*side->temperature, {x, place.region, 0}, step);
    });
    boundary_values_[f] = linear.at_center;
    for (int k = 0; k < directions_of_faces; ++k) boundary_changes_[directions_of_faces * f + k] = linear.changes[k];
  }
}

void MatrixHeat::begin_step(const StepTime& step) {
  evaluate_data(step);
  discretize();
  use_boundary();
}

void MatrixHeat::use_boundary() {
  boundary_fluxes_ = operators_.flux_boundary * boundary_values_ + operators_.flux_change * boundary_changes_;
  if (!wall_heat_flux_) return;
  const Vector trace = operators_.trace_boundary * boundary_values_ + operators_.trace_change * boundary_changes_;
  wall_temperature_.constant.resize(mesh_.wall_count());
  for (int w = 0; w < mesh_.wall_count(); ++w) wall_temperature_.constant[w] = trace[mesh_.wall_face(w)];
}

Vector MatrixHeat::face_heat_fluxes() const { return operators_.flux_cell * temperature_.now() + boundary_fluxes_; }

void MatrixHeat::assemble(Assembly& assembly, const StepTime& step) const {
  if (!assembly.has_row(temperature_)) return;
  SPREKK_EXPECT(step.dt > 0 && is_discretized_, step.dt, name());
  BalanceRows heat(assembly, temperature_, "heat");
  heat.store(capacity_.cwiseProduct(temperature_.now() - temperature_.accepted()),
             BalanceRows::round_off_of_change * capacity_.cwiseProduct(temperature_.now()).lpNorm<Eigen::Infinity>());
  assembly.derivative(temperature_, temperature_, capacity_of_temperature_);
  const Vector fluxes = face_heat_fluxes();
  Vector leaving = Vector::Zero(mesh_.cell_count());
  for (int f = 0; f < mesh_.face_count(); ++f)
    if (mesh_.face_side[f] != none) leaving[mesh_.face_cells[f][0]] += fluxes[f];
  heat.exchange(step.dt * cell_sums(mesh_, fluxes, 1), step.dt * leaving,
                step.dt * largest_conductance_ * temperature_.now().lpNorm<Eigen::Infinity>());
  assembly.derivative(temperature_, temperature_, outflow_of_temperature_, step.dt);
  assembly.compare_with(temperature_, step.dt * fluxes.lpNorm<Eigen::Infinity>());
  if (wall_heat_flux_) assembly.linear(temperature_, outflow_of_wall_flux_, *wall_heat_flux_, step.dt);
  if (!source_.isZero(0)) heat.supply(step.dt * source_);
}

void MatrixHeat::after_solve(const std::vector<Field*>& solved, const StepTime& step) {
  if (std::find(solved.begin(), solved.end(), &temperature_) == solved.end()) return;
  Vector fluxes = face_heat_fluxes();
  if (wall_heat_flux_) fluxes += flux_of_wall_flux_ * wall_heat_flux_->now();
  Vector sums = cumulative_.accepted();
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    sums[3 * c] += capacity_[c] * (temperature_.now()[c] - temperature_.accepted()[c]);
    sums[3 * c + 1] += step.dt * source_[c];
  }
  for (int f = 0; f < mesh_.face_count(); ++f)
    if (mesh_.face_side[f] != none) sums[3 * mesh_.face_cells[f][0] + 2] += step.dt * fluxes[f];
  exchange(mesh_, Location::cell, 3, sums);
  cumulative_.set(std::move(sums));
}

void MatrixHeat::balance(std::map<std::string, Balance>& balances) const {
  Balance& heat = balances["heat"];
  heat.unit = energy_unit;
  add_totals(heat, mesh_, cumulative_);
}

void MatrixHeat::note_input(Notes& notes) const {
  std::vector<const Data*> given;
  for (const auto& [side, condition] : options_.boundary)
    if (condition.temperature) given.push_back(&*condition.temperature);
  note_cold(notes, name(), initial_temperature_, given);
}

void MatrixHeat::note_step(Notes& notes, const StepTime& step) const {
  const Overshoots found = find_overshoots({mesh_, conditions_, temperature_.now(), temperature_.accepted(),
                                            boundary_values_, boundary_changes_, face_heat_fluxes(), capacity_, step.dt,
                                            temperature_.now().lpNorm<Eigen::Infinity>()});
  if (found.cells == 0) return;
  notes.add(
      temperature_.name() + " beyond its surroundings",
      fmt::format("{} is higher or lower than all around it in {} cells without a source, by up to {:.3g} K, {:.2g} "
                  "% of the range of temperatures, at {} (where cells are flat or the conductivity is "
                  "anisotropic, multi-point fluxes keep no bounds); use smaller cells of better shape there, or "
                  "matrix_heat/tpfa, which keeps bounds and is exact where faces are at right angles to the "
                  "lines between centres",
                  temperature_.name(), found.cells, found.largest, 100 * found.largest / found.range,
                  to_text(mesh_.cell_center[found.cell])),
      found.largest);
}

std::vector<double> MatrixHeat::switch_times() const {
  std::vector<const Data*> data = {&options_.source};
  for (const auto& [side, condition] : options_.boundary)
    for (const std::optional<Data>* given : {&condition.temperature, &condition.heat_flux})
      if (*given) data.push_back(&**given);
  return merged_switch_times(data);
}

}  // namespace sprekk::matrix_heat
