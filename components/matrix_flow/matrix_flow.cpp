#include "components/matrix_flow/matrix_flow.hpp"

#include <algorithm>

#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/products.hpp"
#include "framework/discretization/linear_fit.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_mean.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::matrix_flow {

namespace {

/// The operators of rock without permeability: the only fluxes are those that are prescribed on sides.
FluxOperators no_flow(const Mesh& mesh, const std::vector<FlowCondition>& conditions) {
  FluxOperators operators;
  operators.flux_cell.resize(mesh.face_count(), mesh.cell_count());
  operators.trace_cell.resize(mesh.face_count(), mesh.cell_count());
  operators.trace_boundary.resize(mesh.face_count(), mesh.face_count());
  operators.flux_boundary.resize(mesh.face_count(), mesh.face_count());
  operators.flux_change.resize(mesh.face_count(), mesh.face_count());
  operators.trace_change.resize(mesh.face_count(), mesh.face_count());
  operators.blended_nodes.resize(mesh.face_count(), mesh.face_count());
  std::vector<Triplet> prescribed;
  for (int f = 0; f < mesh.face_count(); ++f)
    if (conditions[f] == FlowCondition::flux) prescribed.emplace_back(f, f, 1.0);
  operators.flux_boundary.setFromTriplets(prescribed.begin(), prescribed.end());
  return operators;
}

}  // namespace

MatrixFlow::MatrixFlow(const ComponentContext& context, const Options& options, Discretize discretize)
    : Component(context.name),
      mesh_(context.mesh),
      options_(options),
      origin_(context.origin),
      discretize_(discretize),
      pressure_(context.fields.add(mesh_, {.owner = context.name,
                                           .name = "pressure",
                                           .location = Location::cell,
                                           .role = Role::unknown(BlockKind::bulk_elliptic),
                                           .unit = "Pa",
                                           .doc = "Fluid pressure of the matrix"})),
      cumulative_(context.fields.add(mesh_, {.owner = context.name,
                                             .name = "cumulative_balance",
                                             .location = Location::cell,
                                             .components = 3,
                                             .role = Role::derived(),
                                             .unit = "m^2",
                                             .doc = "Fluid stored, injected, and flowed out through the outer boundary",
                                             .accepted_with = pressure_.name(),
                                             .is_amount = true})) {
  if (mesh_.wall_count() > 0)
    wall_flux_ =
        &context.fields.add(mesh_, {.owner = context.name,
                                    .name = "wall_flux",
                                    .location = Location::wall,
                                    .role = Role::input(BlockKind::interface),
                                    .unit = "m/s",
                                    .doc = "Flux from the fracture into the matrix (lambda of the paper's Eq. 9)"});
  const std::vector<Place> places = cell_places(mesh_);
  const auto property = [&](const Data& data) { return Property(data, places, context.start_time); };
  initial_pressure_ = property(options_.initial_pressure).values();
  pressure_.set_both(initial_pressure_);
  permeability_ = {property(options_.permeability.xx), property(options_.permeability.yy),
                   property(options_.permeability.xy)};
  viscosity_ = property(options_.viscosity);
  if (options_.porosity) porosity_ = property(*options_.porosity);
  if (options_.storage) {
    storage_ = property(*options_.storage);
  } else {
    compressibility_ = property(*options_.fluid_compressibility);
  }
  for (const Data* data : properties()) properties_change_ = properties_change_ || data->depends_on_time();
  use_properties();
  check_sides();

  gravity_potential_cell_.resize(mesh_.cell_count());
  for (int c = 0; c < mesh_.cell_count(); ++c) gravity_potential_cell_[c] = gravity_potential(mesh_.cell_center[c]);
  gravity_potential_face_.resize(mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) gravity_potential_face_[f] = gravity_potential(mesh_.face_center[f]);
}

double MatrixFlow::gravity_potential(const Point& x) const {
  return options_.gravity.is_zero() ? 0.0 : options_.fluid_density * options_.gravity.at({x, 0, 0}).dot(x);
}

std::vector<const Data*> MatrixFlow::properties() const {
  const TensorData& k = options_.permeability;
  std::vector<const Data*> data = {&k.xx, &k.yy, &k.xy, &options_.viscosity};
  for (const std::optional<Data>* given : {&options_.storage, &options_.porosity, &options_.fluid_compressibility})
    if (*given) data.push_back(&**given);
  return data;
}

void MatrixFlow::use_properties() {
  if (!options_.storage) storage_.set(porosity_.values().cwiseProduct(compressibility_.values()));
  std::uint64_t version = viscosity_.version();
  for (const Property& entry : permeability_) version += entry.version();
  if (version == mobility_version_) return;
  mobility_.resize(mesh_.cell_count());
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    Tensor permeability;
    permeability << permeability_[0][c], permeability_[2][c], permeability_[2][c], permeability_[1][c];
    mobility_[c] = permeability / viscosity_[c];
    SPREKK_ASSERT(viscosity_[c] > 0 && mobility_[c].allFinite(), c, viscosity_[c]);
  }
  check_mobility();
  place_wells();
  mobility_version_ = version;  // at the end: a mobility may be refused
}

void MatrixFlow::check_sides() const {
  for (const auto& [side, condition] : options_.boundary)
    if (std::find(mesh_.side_names.begin(), mesh_.side_names.end(), side) == mesh_.side_names.end())
      throw unknown_name(condition.origin, "side of the boundary", side, mesh_.side_names);
  for (const auto& [name, well] : options_.wells)
    if (well_cells_.at(name).empty())
      throw InputError(well.origin, "well '" + name + "' lies outside the rock", "there is no cell at its position",
                       "move it inside");
}

void MatrixFlow::check_mobility() {
  long sealed = 0;
  for (const Tensor& mobility : mobility_) {
    sealed += mobility.isZero(0);
    if (!mobility.isZero(0) && mobility(0, 0) * mobility(1, 1) <= mobility(0, 1) * mobility(1, 0))
      throw DataError(InputError(origin_, "the permeability is not positive definite",
                                 "fluid could not flow in one direction", "raise it in that direction")
                          .what());
  }
  is_sealed_ = sealed == mesh_.cell_count();
  if (sealed > 0 && !is_sealed_)
    throw DataError(InputError(origin_, "the permeability is zero in a part of the rock",
                               "there is no pressure at the face of a cell that lets no fluid through",
                               "give that part a very small permeability")
                        .what());
}

void MatrixFlow::place_wells() {
  // Fluid of a well must not be added to rock of another permeability, where it might not be able to flow away.
  const auto is_like = [&](int cell, int other) {
    const double ratio = mobility_[other].trace() / mobility_[cell].trace();
    constexpr double most = 2;
    return is_sealed_ || (ratio > 1 / most && ratio < most);
  };
  for (const auto& [name, well] : options_.wells) well_cells_[name] = linear_fit(mesh_, well.at, is_like);
}

void MatrixFlow::find_conditions() {
  conditions_.assign(mesh_.face_count(), FlowCondition::none);
  outer_faces_.clear();
  for (int f = 0; f < mesh_.face_count(); ++f) {
    if (mesh_.face_cells[f][1] != none) continue;
    conditions_[f] = FlowCondition::flux;
    if (mesh_.face_side[f] == none) continue;
    outer_faces_.emplace_back(f, mesh_.face_cells[f][0]);
    const auto condition = options_.boundary.find(mesh_.side_names[mesh_.face_side[f]]);
    if (condition != options_.boundary.end() && condition->second.pressure) conditions_[f] = FlowCondition::pressure;
  }
}

bool MatrixFlow::is_discretized() const {
  return discretized_mesh_ == mesh_.version && discretized_mobility_ == mobility_version_;
}

void MatrixFlow::discretize() {
  if (is_discretized()) return;
  find_conditions();
  if (is_sealed_) {
    operators_ = no_flow(mesh_, conditions_);
  } else if (!mobility_of_operators_.empty()) {
    return discretize_from({mesh_, mobility_of_operators_, conditions_}, operators_, no_change(mesh_));
  } else {
    const std::vector<char> nodes = nodes_to_discretize(mesh_);
    ++discretizations_;
    discretized_cells_ += mesh_.cell_count();
    discretized_regions_ += nodes.empty() ? mesh_.node_count() : std::count(nodes.begin(), nodes.end(), 1);
    FluxOperators made = discretize_(mesh_, mobility_, conditions_, nodes);
    operators_.swap(made);
  }
  use_operators();
}

void MatrixFlow::carry_over(const Part& part, const MeshChange& change) {
  const MatrixFlow& before = dynamic_cast<const MatrixFlow&>(part);
  SPREKK_EXPECT(static_cast<int>(change.cell.size()) == mesh_.cell_count(), change.cell.size(), mesh_.cell_count());
  // With several processes the change may have given cells to others.
  if (parallel::size() > 1 || is_sealed_ || before.is_sealed_ || !before.is_discretized()) return;
  find_conditions();
  discretize_from({before.mesh_, before.mobility_, before.conditions_}, before.operators_, change);
}

void MatrixFlow::discretize_from(const FlowInputs& before, const FluxOperators& operators, const MeshChange& change) {
  Rediscretized result = rediscretize(discretize_, before, operators, {mesh_, mobility_, conditions_}, change);
  ++discretizations_;
  discretized_cells_ += result.cells;
  discretized_regions_ += result.regions;
  operators_.swap(result.operators);
  use_operators();
}

void MatrixFlow::use_operators() {
  discretized_mesh_ = mesh_.version;
  discretized_mobility_ = mobility_version_;
  mobility_of_operators_.clear();
  if (properties_change_ && !is_sealed_ && parallel::size() == 1) mobility_of_operators_ = mobility_;
  boundary_applied_ = false;
  forget_flow();
  const int rank = parallel::rank();
  // Flux through an inner face leaves one cell and enters another.
  std::vector<char> is_outer(mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) is_outer[f] = mesh_.face_cells[f][1] == none;
  const auto outflow_of = [&](const SparseMatrix& fluxes) {
    return Operator(cell_sums(mesh_, fluxes, 1, rank), cell_sums(mesh_, keep_rows(fluxes, is_outer), 1, rank));
  };
  outflow_of_pressure_ = outflow_of(operators_.flux_cell);
  SPREKK_ASSERT(operators_.flux_cell.rows() == mesh_.face_count(), operators_.flux_cell.rows(), mesh_.face_count());
  SPREKK_ASSERT(operators_.flux_cell.cols() == mesh_.cell_count(), operators_.flux_cell.cols(), mesh_.cell_count());
  SPREKK_ASSERT(operators_.flux_boundary.cols() == mesh_.face_count(), operators_.flux_boundary.cols());
  SPREKK_ASSERT(is_finite(operators_.flux_cell) && is_finite(operators_.flux_boundary));
  largest_conductance_ = 0;
  const SparseMatrix& outflow = outflow_of_pressure_.entries();
  for (int row = 0; row < outflow.rows(); ++row)
    largest_conductance_ = std::max(largest_conductance_, outflow.row(row).cwiseAbs().sum());
  if (!wall_flux_) return;

  // The flux out of the rock through a wall is −lambda times its length.
  std::vector<Triplet> entries;
  for (int w = 0; w < mesh_.wall_count(); ++w)
    entries.emplace_back(mesh_.wall_face(w), w, -mesh_.face_measure[mesh_.wall_face(w)]);
  SparseMatrix boundary_of_wall_flux(mesh_.face_count(), mesh_.wall_count());
  boundary_of_wall_flux.setFromTriplets(entries.begin(), entries.end());
  flux_of_wall_flux_ = operators_.flux_boundary * boundary_of_wall_flux;
  outflow_of_wall_flux_ = outflow_of(flux_of_wall_flux_);

  entries.clear();
  for (int w = 0; w < mesh_.wall_count(); ++w)
    if (is_owned(mesh_, Location::wall, w)) entries.emplace_back(w, mesh_.wall_face(w), 1.0);
  SparseMatrix pick_walls(mesh_.wall_count(), mesh_.face_count());
  pick_walls.setFromTriplets(entries.begin(), entries.end());
  wall_pressure_.terms = {{&pressure_, Operator(pick_walls * operators_.trace_cell)},
                          {wall_flux_, Operator(pick_walls * operators_.trace_boundary * boundary_of_wall_flux)}};
}

void MatrixFlow::use_storage() {
  if (capacity_version_ == storage_.version()) return;
  capacity_version_ = storage_.version();
  SPREKK_ASSERT(storage_.values().size() == mesh_.cell_count(), storage_.values().size(), mesh_.cell_count());
  SPREKK_ASSERT(storage_.values().size() == 0 || storage_.values().minCoeff() >= 0, storage_.values().minCoeff());
  capacity_ = storage_.values().cwiseProduct(Eigen::Map<const Vector>(mesh_.cell_measure.data(), mesh_.cell_count()));
  capacity_of_pressure_ = Operator(diagonal_matrix(capacity_));
}

bool MatrixFlow::depends_on_time() const {
  return properties_change_ || options_.source.depends_on_time() ||
         std::any_of(options_.wells.begin(), options_.wells.end(),
                     [](const auto& well) { return well.second.rate.depends_on_time(); }) ||
         std::any_of(options_.boundary.begin(), options_.boundary.end(),
                     [](const auto& side) { return side.second.depends_on_time(); });
}

void MatrixFlow::evaluate_data(const StepTime& step) {
  const bool same_step = evaluated_for_.start == step.start && evaluated_for_.end == step.end;
  const bool is_evaluated = data_evaluated_ && (same_step || !depends_on_time());
  if (properties_change_ && !is_evaluated) {
    for (Property& entry : permeability_) entry.evaluate(step);
    for (Property* property : {&viscosity_, &porosity_, &compressibility_, &storage_}) property->evaluate(step);
    use_properties();
  }
  if (is_sealed_ && wall_flux_ && !wall_flux_->determined_by().empty())
    throw DataError(InputError(origin_, "fluid is to flow through the walls of rock that has no permeability",
                               "what enters a cell could not leave it",
                               "remove the coupler of its walls, or give it a permeability")
                        .what());
  if (is_evaluated) return;
  data_evaluated_ = true;
  evaluated_for_ = step;
  boundary_applied_ = false;
  forget_flow();
  evaluate_sources(step);
  boundary_values_ = Vector::Zero(mesh_.face_count());
  boundary_changes_ = Vector::Zero(mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) {
    if (mesh_.face_side[f] == none) continue;
    const auto found = options_.boundary.find(mesh_.side_names[mesh_.face_side[f]]);
    if (found == options_.boundary.end()) continue;
    const Place place{mesh_.face_center[f], mesh_.cell_region[mesh_.face_cells[f][0]], 0};
    const SideCondition& side = found->second;
    if (side.pressure && (side.pressure->depends_on_space() || !options_.gravity.is_zero())) {
      // At the third points of the face: these are exact for linear pressures on the face.
      const Point third = (mesh_.nodes[mesh_.face_nodes[f][1]] - mesh_.nodes[mesh_.face_nodes[f][0]]) / 6;
      const auto value = [&](const Point& x) {
        return value_in_step(*side.pressure, {x, place.region, 0}, step) - gravity_potential(x);
      };
      const double first = value(place.x - third), second = value(place.x + third);
      boundary_values_[f] = 0.5 * (first + second);
      boundary_changes_[f] = 3 * (second - first);
    } else if (side.pressure) {
      boundary_values_[f] = value_in_step(*side.pressure, place, step);
    }
    if (side.flux) boundary_values_[f] = value_in_step(*side.flux, place, step) * mesh_.face_measure[f];
  }
}

void MatrixFlow::apply_boundary() {
  if (boundary_applied_) return;
  boundary_applied_ = true;
  SPREKK_ASSERT(boundary_values_.size() == mesh_.face_count(), boundary_values_.size(), mesh_.face_count());
  SPREKK_ASSERT(is_finite(boundary_values_) && is_finite(boundary_changes_));
  boundary_fluxes_ = operators_.flux_boundary * boundary_values_ + operators_.flux_change * boundary_changes_;
  if (!wall_flux_) return;
  const Vector trace = operators_.trace_boundary * boundary_values_ + operators_.trace_change * boundary_changes_ -
                       operators_.trace_cell * gravity_potential_cell_ + gravity_potential_face_;
  wall_pressure_.constant.resize(mesh_.wall_count());
  for (int w = 0; w < mesh_.wall_count(); ++w) wall_pressure_.constant[w] = trace[mesh_.wall_face(w)];
}

void MatrixFlow::evaluate_sources(const StepTime& step) {
  source_ = Vector::Zero(mesh_.cell_count());
  if (!options_.source.is_zero())
    for (int c = 0; c < mesh_.cell_count(); ++c) {
      const auto density = [&](const Point& at) {
        return value_in_step(options_.source, {at, mesh_.cell_region[c], 0}, step);
      };
      source_[c] = mesh_.cell_measure[c] *
                   (options_.source.depends_on_space() ? cell_mean(mesh_, c, density) : density(mesh_.cell_center[c]));
    }
  for (const auto& [name, well] : options_.wells) {
    const double rate = value_in_step(well.rate, {well.at, 0, 0}, step);
    for (const auto& [cell, weight] : well_cells_.at(name)) source_[cell] += weight * rate;
    SPREKK_ASSERT(std::isfinite(rate), name, rate);
  }
}

void MatrixFlow::begin_step(const StepTime& step) {
  evaluate_data(step);
  discretize();
  use_storage();
  apply_boundary();
}

void MatrixFlow::assemble(Assembly& assembly, const StepTime& step) const {
  if (!assembly.has_row(pressure_)) return;
  SPREKK_EXPECT(step.dt > 0, step.dt);
  SPREKK_EXPECT(is_discretized() && boundary_applied_, name());
  SPREKK_ASSERT(capacity_.size() == mesh_.cell_count() && source_.size() == mesh_.cell_count(), capacity_.size());
  BalanceRows fluid(assembly, pressure_, "fluid");
  fluid.store(capacity_.cwiseProduct(pressure_.now() - pressure_.accepted()),
              capacity_.cwiseProduct(pressure_.now()).lpNorm<Eigen::Infinity>());
  assembly.derivative(pressure_, pressure_, capacity_of_pressure_);
  // Fluxes depend on differences of pressure only, so their terms are added together and compared with the fluxes
  // through faces: single terms of the pressure would hide them where the pressure is high everywhere. Where all terms
  // vanish, the residual is compared with the flow before the step.
  const double largest_before = flow(pressure_.accepted(), pressure_.accepted_version()).largest_outflow;
  const Flow& flows = flow(pressure_.now(), pressure_.version());
  fluid.exchange(step.dt * flows.outflow, step.dt * flows.leaving,
                 step.dt * largest_conductance_ * pressure_.now().lpNorm<Eigen::Infinity>());
  assembly.derivative(pressure_, pressure_, outflow_of_pressure_, step.dt);
  assembly.compare_with(pressure_, step.dt * face_fluxes().lpNorm<Eigen::Infinity>());
  assembly.compare_with(pressure_, step.dt * largest_before);
  if (wall_flux_) assembly.linear(pressure_, outflow_of_wall_flux_, *wall_flux_, step.dt);
  if (!source_.isZero(0)) fluid.supply(step.dt * source_);
}

void MatrixFlow::forget_flow() {
  flows_ = {};
  with_walls_ = {};
}

const MatrixFlow::Flow& MatrixFlow::flow(const Vector& pressure, std::uint64_t version) const {
  for (Flow& kept : flows_)
    if (kept.used > 0 && kept.pressure == version) {
      kept.used = ++flow_uses_;
      return kept;
    }
  Flow& flow = flows_[flows_[0].used <= flows_[1].used ? 0 : 1];
  SPREKK_EXPECT(pressure.size() == mesh_.cell_count(), pressure.size(), mesh_.cell_count());
  flow.pressure = version;
  flow.used = ++flow_uses_;
  flow.fluxes = multiply(operators_.flux_cell, pressure - gravity_potential_cell_, false).value;
  flow.fluxes += boundary_fluxes_;
  flow.outflow = cell_sums(mesh_, flow.fluxes, 1);
  flow.leaving = Vector::Zero(mesh_.cell_count());
  for (const auto& [face, cell] : outer_faces_) flow.leaving[cell] += flow.fluxes[face];
  flow.largest_outflow = flow.outflow.lpNorm<Eigen::Infinity>();
  return flow;
}

const Vector& MatrixFlow::face_fluxes() const {
  const Flow& flow = this->flow(pressure_.now(), pressure_.version());
  if (!wall_flux_) return flow.fluxes;
  if (with_walls_.fluxes.size() == 0 || with_walls_.pressure != flow.pressure ||
      with_walls_.wall_flux != wall_flux_->version())
    with_walls_ = {flow.pressure, wall_flux_->version(), flow.fluxes + flux_of_wall_flux_ * wall_flux_->now()};
  return with_walls_.fluxes;
}

void MatrixFlow::after_solve(const std::vector<Field*>& solved, const StepTime& step) {
  if (std::find(solved.begin(), solved.end(), &pressure_) == solved.end()) return;
  const Vector& fluxes = face_fluxes();
  Vector sums = cumulative_.accepted();
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    sums[3 * c] += storage_[c] * mesh_.cell_measure[c] * (pressure_.now()[c] - pressure_.accepted()[c]);
    sums[3 * c + 1] += step.dt * source_[c];
  }
  for (const auto& [face, cell] : outer_faces_) sums[3 * cell + 2] += step.dt * fluxes[face];
  replicate(mesh_, Location::cell, 3, sums);
  cumulative_.set(std::move(sums));
}

void MatrixFlow::balance(std::map<std::string, Balance>& balances) const {
  Balance& fluid = balances["fluid"];
  fluid.unit = "m^2";
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    fluid.stored += cumulative_.now()[3 * c];
    fluid.injected += cumulative_.now()[3 * c + 1];
    fluid.outflow += cumulative_.now()[3 * c + 2];
    fluid.throughput += cumulative_.now().segment<3>(3 * c).lpNorm<1>();
  }
}

std::vector<double> MatrixFlow::switch_times() const {
  std::vector<double> times = merged_switch_times(properties());
  const auto append = [&](const Data& data) {
    times.insert(times.end(), data.switch_times().begin(), data.switch_times().end());
  };
  append(options_.source);
  for (const auto& [name, well] : options_.wells) append(well.rate);
  for (const auto& [side, condition] : options_.boundary) {
    if (condition.pressure) append(*condition.pressure);
    if (condition.flux) append(*condition.flux);
  }
  return times;
}

void MatrixFlow::hold_constants(ConstantModes& modes) const {
  const bool has_pressure = std::any_of(options_.boundary.begin(), options_.boundary.end(),
                                        [](const auto& side) { return side.second.pressure.has_value(); });
  if (is_sealed_ ? storage_.values().minCoeff() > 0 : has_pressure || storage_.values().maxCoeff() > 0) return;
  modes.floats(pressure_, origin_, "nothing stores fluid and no side has a pressure: any constant may be added to it",
               "give a storage, or the pressure of a side");
}

void MatrixFlow::output(std::vector<OutputField>& fields) const {
  // Cell-wise Darcy velocity from the fluxes: V v = sum over faces of flux · (x_face − x_cell), exact for a constant
  // one.
  if (discretized_mobility_ == 0) return;
  const Vector& fluxes = face_fluxes();
  Vector velocity = Vector::Zero(2 * mesh_.cell_count());
  for (int c = 0; c < mesh_.cell_count(); ++c)
    for (const int face : mesh_.cell_faces[c]) {
      const double out = mesh_.face_cells[face][0] == c ? fluxes[face] : -fluxes[face];
      velocity.segment<2>(2 * c) += out * (mesh_.face_center[face] - mesh_.cell_center[c]) / mesh_.cell_measure[c];
    }
  replicate(mesh_, Location::cell, 2, velocity);
  fields.push_back({name() + ".velocity", "m/s", Location::cell, 2, std::move(velocity)});
}

}  // namespace sprekk::matrix_flow
