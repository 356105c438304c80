#include "components/matrix_transport/matrix_transport.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "components/capabilities/cold.hpp"
#include "components/capabilities/overshoots.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/property.hpp"
#include "framework/discretization/changes_along_face.hpp"
#include "framework/field/counted_amounts.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/field/wall_matrices.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_mean.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::matrix_transport {

MatrixTransport::MatrixTransport(const ComponentContext& context, const Carried& carried, const Options& options,
                                 DiscretizeFlux discretize)
    : Component(context.name),
      mesh_(context.mesh),
      carried_(carried),
      options_(options),
      origin_(context.origin),
      discretize_(discretize),
      value_(context.fields.add(mesh_, {.owner = context.name,
                                        .name = carried.value,
                                        .location = Location::cell,
                                        .role = Role::unknown(BlockKind::bulk_elliptic),
                                        .unit = carried.unit,
                                        .doc = capitalized(carried.value) + " in the matrix"})),
      cumulative_(context.fields.add(
          mesh_,
          amounts_with(value_, context.name, "cumulative_" + carried.quantity, carried.amount_unit,
                       capitalized(carried.quantity) + " stored, generated, and conducted out through the boundary" +
                           (options.decay.is_zero() ? "" : " or decayed"),
                       3))) {
  if (mesh_.wall_count() > 0)
    wall_flux_ = &context.fields.add(
        mesh_, {.owner = context.name,
                .name = "wall_" + carried.quantity + "_flux",
                .location = Location::wall,
                .role = Role::input(BlockKind::interface),
                .unit = carried.flux_unit,
                .doc = capitalized(carried.quantity) + " conducted from the fracture into the matrix"});
  check_sides();
  read_properties(context.start_time);
  value_.set_both(initial_value_);
}

void MatrixTransport::check_sides() const {
  for (const auto& [side, condition] : options_.boundary)
    if (std::find(mesh_.side_names.begin(), mesh_.side_names.end(), side) == mesh_.side_names.end())
      throw unknown_name(condition.origin, "side of the boundary", side, mesh_.side_names);
}

void MatrixTransport::read_properties(double start) {
  const std::vector<Place> places = cell_places(mesh_);
  initial_value_ = Property(options_.initial_value, places, start).values();
  const Vector porosity = Property(options_.porosity, places, start).values();
  capacity_ = Property(options_.capacity, places, start).values().cwiseProduct(porosity);
  if (!options_.decay.is_zero()) decay_ = Property(options_.decay, places, start).values();
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    capacity_[c] *= mesh_.cell_measure[c];
    conductivity_.emplace_back(porosity[c] * options_.conductivity.at(places[c]));
    const Tensor& k = conductivity_.back();
    if (!(k.trace() > 0) || !(k.determinant() > 0))
      throw DataError(InputError(origin_, "the " + carried_.conductivity + " is not positive definite",
                                 carried_.quantity + " could not be conducted in one direction",
                                 "raise it in that direction")
                          .what());
  }
}

const SideCondition* MatrixTransport::condition(int face) const {
  if (mesh_.face_side[face] == none) return nullptr;
  const auto found = options_.boundary.find(mesh_.side_names[mesh_.face_side[face]]);
  return found == options_.boundary.end() ? nullptr : &found->second;
}

std::optional<double> MatrixTransport::side_value(int face) const {
  const SideCondition* side = condition(face);
  if (!side || !side->value) return std::nullopt;
  return boundary_values_[face];
}

void MatrixTransport::discretize() {
  if (is_discretized_ && discretized_mesh_ == mesh_.version) return;
  conditions_.assign(mesh_.face_count(), FlowCondition::none);
  for (int f = 0; f < mesh_.face_count(); ++f) {
    if (mesh_.face_cells[f][1] != none) continue;
    const SideCondition* side = condition(f);
    conditions_[f] = side && side->value ? FlowCondition::pressure : FlowCondition::flux;
  }
  std::vector<Tensor> conductivity = conductivity_;
  for (std::size_t c = 0; c < added_.size(); ++c) conductivity[c] += added_[c];
  FluxOperators made = discretize_(mesh_, conductivity, conditions_, nodes_to_discretize(mesh_));
  operators_.swap(made);
  use_operators();
  is_discretized_ = true;
  discretized_mesh_ = mesh_.version;
}

void MatrixTransport::add_conductivity(std::vector<Tensor> added) {
  if (added == added_) return;
  added_ = std::move(added);
  if (!is_discretized_) return;
  is_discretized_ = false;
  discretize();
  use_boundary();
}

void MatrixTransport::use_operators() {
  std::vector<char> is_outer(mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) is_outer[f] = mesh_.face_cells[f][1] == none;
  const int rank = parallel::rank();
  const auto outflow_of = [&](const SparseMatrix& fluxes) {
    return Operator(cell_sums(mesh_, fluxes, 1, rank), cell_sums(mesh_, keep_rows(fluxes, is_outer), 1, rank));
  };
  capacity_of_value_ = Operator(diagonal_matrix(capacity_));
  outflow_of_value_ = outflow_of(operators_.flux_cell);
  SPREKK_ASSERT(is_finite(operators_.flux_cell) && is_finite(operators_.flux_boundary));
  largest_conductance_ = 0;
  const SparseMatrix& outflow = outflow_of_value_.entries();
  for (int row = 0; row < outflow.rows(); ++row)
    largest_conductance_ = std::max(largest_conductance_, outflow.row(row).cwiseAbs().sum());
  if (!wall_flux_) return;

  // The flux out of the rock through a wall is minus the flux into it, times its length.
  boundary_of_wall_flux_ = outflow_of_wall_fluxes(mesh_);
  flux_of_wall_flux_ = operators_.flux_boundary * boundary_of_wall_flux_;
  outflow_of_wall_flux_ = outflow_of(flux_of_wall_flux_);
  const SparseMatrix pick_walls = owned_walls_of_faces(mesh_);
  wall_value_.terms = {{&value_, Operator(pick_walls * operators_.trace_cell)},
                       {wall_flux_, Operator(pick_walls * operators_.trace_boundary * boundary_of_wall_flux_)}};
}

void MatrixTransport::evaluate_data(const StepTime& step) {
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
    if (side->flux) boundary_values_[f] = value_in_step(*side->flux, place, step) * mesh_.face_measure[f];
    if (!side->value) continue;
    const LinearOnFace linear = linear_on_face(mesh_, f, [&](const Point& x) {
      return value_in_step(*side->value, {x, place.region, 0}, step);
    });
    boundary_values_[f] = linear.at_center;
    for (int k = 0; k < directions_of_faces; ++k) boundary_changes_[directions_of_faces * f + k] = linear.changes[k];
  }
}

void MatrixTransport::begin_step(const StepTime& step) {
  evaluate_data(step);
  discretize();
  use_boundary();
}

void MatrixTransport::use_boundary() {
  boundary_fluxes_ = operators_.flux_boundary * boundary_values_ + operators_.flux_change * boundary_changes_;
  if (!wall_flux_) return;
  const Vector trace = operators_.trace_boundary * boundary_values_ + operators_.trace_change * boundary_changes_;
  wall_value_.constant.resize(mesh_.wall_count());
  for (int w = 0; w < mesh_.wall_count(); ++w) wall_value_.constant[w] = trace[mesh_.wall_face(w)];
}

Vector MatrixTransport::face_fluxes() const { return operators_.flux_cell * value_.now() + boundary_fluxes_; }

void MatrixTransport::assemble(Assembly& assembly, const StepTime& step) const {
  if (!assembly.has_row(value_)) return;
  SPREKK_EXPECT(step.dt > 0 && is_discretized_, step.dt, name());
  BalanceRows rows(assembly, value_, carried_.quantity);
  rows.store(capacity_.cwiseProduct(value_.now() - value_.accepted()),
             BalanceRows::round_off_of_change * capacity_.cwiseProduct(value_.now()).lpNorm<Eigen::Infinity>());
  assembly.derivative(value_, value_, capacity_of_value_);
  const Vector fluxes = face_fluxes();
  Vector leaving = Vector::Zero(mesh_.cell_count());
  for (int f = 0; f < mesh_.face_count(); ++f)
    if (mesh_.face_side[f] != none) leaving[mesh_.face_cells[f][0]] += fluxes[f];
  rows.exchange(step.dt * cell_sums(mesh_, fluxes, 1), step.dt * leaving,
                step.dt * largest_conductance_ * value_.now().lpNorm<Eigen::Infinity>());
  assembly.derivative(value_, value_, outflow_of_value_, step.dt);
  assembly.compare_with(value_, step.dt * fluxes.lpNorm<Eigen::Infinity>());
  if (wall_flux_) assembly.linear(value_, outflow_of_wall_flux_, *wall_flux_, step.dt);
  if (!source_.isZero(0)) rows.supply(step.dt * source_);
  if (decay_.size() == 0) return;
  const Vector decaying = step.dt * decay_.cwiseProduct(capacity_);
  rows.supply(-decaying.cwiseProduct(value_.now()));
  assembly.diagonal(value_, value_, decaying);
}

void MatrixTransport::after_solve(const std::vector<Field*>& solved, const StepTime& step) {
  if (std::find(solved.begin(), solved.end(), &value_) == solved.end()) return;
  Vector fluxes = face_fluxes();
  if (wall_flux_) fluxes += flux_of_wall_flux_ * wall_flux_->now();
  Vector sums = cumulative_.accepted();
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    sums[3 * c] += capacity_[c] * (value_.now()[c] - value_.accepted()[c]);
    sums[3 * c + 1] += step.dt * source_[c];
    if (decay_.size() > 0) sums[3 * c + 2] += step.dt * decay_[c] * capacity_[c] * value_.now()[c];
  }
  for (int f = 0; f < mesh_.face_count(); ++f)
    if (mesh_.face_side[f] != none) sums[3 * mesh_.face_cells[f][0] + 2] += step.dt * fluxes[f];
  exchange(mesh_, Location::cell, 3, sums);
  cumulative_.set(std::move(sums));
}

void MatrixTransport::balance(std::map<std::string, Balance>& balances) const {
  Balance& balance = balances[carried_.quantity];
  balance.unit = carried_.amount_unit;
  add_totals(balance, mesh_, cumulative_);
}

void MatrixTransport::note_input(Notes& notes) const {
  if (!carried_.has_absolute_zero) return;
  std::vector<const Data*> given;
  for (const auto& [side, condition] : options_.boundary)
    if (condition.value) given.push_back(&*condition.value);
  note_cold(notes, name(), initial_value_, given);
}

void MatrixTransport::note_step(Notes& notes, const StepTime& step) const {
  const Overshoots found =
      find_overshoots({mesh_, conditions_, value_.now(), value_.accepted(), boundary_values_, boundary_changes_,
                       face_fluxes(), capacity_, step.dt, value_.now().lpNorm<Eigen::Infinity>()});
  if (found.cells == 0) return;
  notes.add(
      value_.name() + " beyond its surroundings",
      fmt::format("{} is higher or lower than all around it in {} cells without a source, by up to {:.3g} {}, {:.2g} "
                  "% of the range of {}s, at {} (where cells are flat or the {} is anisotropic, multi-point fluxes "
                  "keep no bounds); use smaller cells of better shape there, or {}/tpfa, which keeps "
                  "bounds and is exact where faces are at right angles to the lines between centres",
                  value_.name(), found.cells, found.largest, carried_.unit, 100 * found.largest / found.range,
                  carried_.value, to_text(mesh_.cell_center[found.cell]), carried_.conductivity, carried_.matrix_type),
      found.largest);
}

std::vector<double> MatrixTransport::switch_times() const {
  std::vector<const Data*> data = {&options_.source};
  for (const auto& [side, condition] : options_.boundary)
    for (const std::optional<Data>* given : {&condition.value, &condition.flux})
      if (*given) data.push_back(&**given);
  return merged_switch_times(data);
}

}  // namespace sprekk::matrix_transport
