#include "components/fracture_flow/tpfa/fracture_flow.hpp"

#include <algorithm>

#include "framework/assembly/balance_rows.hpp"
#include "framework/field/counted_amounts.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/scene/fracture_set.hpp"

namespace sprekk::fracture_flow {

FractureFlow::FractureFlow(const ComponentContext& context, const Options& options)
    : Component(context.name),
      mesh_(context.mesh),
      options_(options),
      origin_(context.origin),
      pressure_(context.fields.add(mesh_, {.owner = context.name,
                                           .name = "pressure",
                                           .location = Location::fracture_cell,
                                           .role = Role::unknown(BlockKind::interface),
                                           .unit = "Pa",
                                           .doc = "Fluid pressure in the fractures"})),
      flux_(
          context.fields.add(mesh_, {.owner = context.name,
                                     .name = "flux",
                                     .location = Location::ridge,
                                     .role = Role::unknown(BlockKind::interface),
                                     .unit = volume_rate_unit,
                                     .doc = "Flux along the fractures, from the first to the second cell of a ridge"})),
      aperture_(context.fields.add(mesh_, {.owner = context.name,
                                           .name = "aperture",
                                           .location = Location::fracture_cell,
                                           .role = Role::input(BlockKind::interface),
                                           .unit = "m",
                                           .doc = "Aperture of the fractures (below the paper's Eq. 8)"})),
      cumulative_(context.fields.add(
          mesh_, amounts_with(pressure_, context.name, "cumulative_balance", volume_unit,
                              "Fluid stored, injected, and flowed out through the outer boundary", 3))),
      wet_(fracture_set(mesh_, options_.fractures, options_.fractures_origin)),
      state_(conduction_variables()),
      outflows_(mesh_) {
  if (mesh_.fracture_cell_count() == 0)
    throw InputError(context.origin, "component '" + context.name + "' has nothing to do", "the scene has no fractures",
                     "add fractures to `geometry:` or remove the component");
  check_names();
  find_prescribed_cells();
  options_.crossings.check_names(mesh_);
  crossing_fills_ = options_.crossings.fills(mesh_);
  if (options_.cavitation)
    empty_ = &context.fields.add(
        mesh_, {.owner = context.name,
                .name = "empty",
                .location = Location::fracture_cell,
                .role = Role::unknown(BlockKind::interface),
                .unit = "m",
                .doc = "The part of the aperture that has no fluid, where the pressure is as low as it can be"});
  const auto is_point = [](const auto& prescribed) { return prescribed.second.where.at.has_value(); };
  if (const auto points = std::ranges::count_if(options_.prescribed, is_point); points > 0)
    let_in_at_points_ = &context.fields.add(mesh_, {.owner = context.name,
                                                    .name = "let_in",
                                                    .location = Location::listed,
                                                    .listed = static_cast<int>(points),
                                                    .role = Role::unknown(BlockKind::interface),
                                                    .unit = volume_rate_unit,
                                                    .doc = "What enters at points with a prescribed pressure"});
  const std::vector<Place> places = fracture_cell_places(mesh_);
  const auto property = [&](const Data& data) { return Property(data, places, context.start_time); };
  initial_aperture_ = property(options_.initial_aperture).values();
  check_bound(property(options_.initial_pressure).values().minCoeff(), context.origin, "the initial pressure");
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    if (mesh_.fracture_cells[i].grown) initial_aperture_[i] = options_.grown_aperture;
  aperture_.set_both(initial_aperture_);
  Vector initial_pressure = property(options_.initial_pressure).values();
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    if (!is_in_fracture_cell(i)) initial_pressure[i] = 0;
  pressure_.set_both(std::move(initial_pressure));
  law_ = options_.law.make(options_.aperture_floor);
  prepare_formula(context.fields);
  viscosity_ = property(options_.viscosity);
  compressibility_ = property(options_.fluid_compressibility);
  inertia_ = property(options_.law.inertia);
  const double start = context.start_time;
  if (const std::optional<Data>& given = options_.given_transmissivity()) {
    given_transmissivity_ = {*given, whole_cells(mesh_), Mean::of_values, start};
    for (int place = 0; place < most_ridges(mesh_); ++place)
      transmissivity_of_part_.emplace_back(*given, parts_of_cells(mesh_, place), Mean::of_reciprocals, start);
  }
  if (options_.normal_permeability_value)
    given_normal_permeability_ = {*options_.normal_permeability_value, whole_cells(mesh_), Mean::of_values, start};
  for (int wall = 0; wall < 2; ++wall)
    if (const std::optional<Data>& given = options_.wall_permeability[wall])
      given_wall_permeability_[wall] = {*given, whole_cells(mesh_), Mean::of_values, start};
}

std::vector<const Data*> FractureFlow::properties() const {
  std::vector<const Data*> data = {&options_.viscosity, &options_.fluid_compressibility, &options_.law.inertia};
  for (const std::optional<Data>* given : {&options_.given_transmissivity(), &options_.normal_permeability_value,
                                           &options_.wall_permeability[0], &options_.wall_permeability[1]})
    if (*given) data.push_back(&**given);
  if (const Data* formula = options_.conduction_formula()) data.push_back(formula);
  return data;
}

void FractureFlow::carry_over(const Part&, const MeshChange& change) {
  if (history_) history_->hold(true);
  // A cell that covers a given-up one has its pressure, and its fluid is spread over the new length.
  const Vector covered = covered_parts(change, mesh_);
  const auto is_new = [&](int cell) { return covered[cell] == 0; };
  Vector pressure = pressure_.now(), aperture = aperture_.accepted();
  std::vector<char> known(pressure.size());
  for (int i = 0; i < pressure.size(); ++i) known[i] = !is_new(i);
  // New cells follow each other from the ends of old ones: each sweep reaches one more cell.
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (int i = 0; i < pressure.size(); ++i) {
      if (known[i]) continue;
      for (const int ridge : mesh_.fracture_cells[i].ridges)
        for (const int other : mesh_.ridges[ridge].cells)
          if (known[other] && !known[i] && mesh_.fracture_cells[other].fracture == mesh_.fracture_cells[i].fracture) {
            pressure[i] = pressure[other];
            known[i] = 1;
            goes_on = true;
          }
    }
  }
  // What is empty of a given-up cell is so in the cells in its place.
  if (empty_) empty_->set_both(covered.cwiseProduct(empty_->accepted()));
  const double filled = options_.grown_fluid == "drawn" ? 0 : options_.grown_aperture;
  for (int i = 0; i < aperture.size(); ++i)
    if (covered[i] < 1) aperture[i] = covered[i] * aperture[i] + (1 - covered[i]) * filled;
  pressure_.set_both(std::move(pressure));
  // Both, since the settled state is accepted as a whole: the fluid of the next step is counted from here.
  aperture_.set_both(std::move(aperture));
}

std::optional<OutsideOfRock> FractureFlow::outside_of_end(const Ridge& end, const Place& place,
                                                          const StepTime& step) const {
  const std::string& side = mesh_.side_names[end.side];
  if (!options_.is_open(side)) return std::nullopt;
  const EndCondition& given = options_.ends.at(side);
  if (given.is_as_rock) return rock_fluid_ ? rock_fluid_->outside(end.side, place, step) : std::nullopt;
  if (given.pressure) return OutsideOfRock{value_in_step(*given.pressure, place, step)};
  OutsideOfRock outside{value_in_step(*given.outer_pressure, place, step), std::nullopt, given.only_out};
  if (given.conductance) outside.conductance = value_in_step(*given.conductance, place, step);
  return outside;
}

void FractureFlow::make_links(const StepTime& step) {
  links_.clear();
  std::vector<std::pair<int, int>> place_of(mesh_.ridges.size(), {none, none});
  for (std::size_t j = 0; j < mesh_.junctions.size(); ++j)
    for (std::size_t k = 0; k < mesh_.junctions[j].ridges.size(); ++k)
      place_of[mesh_.junctions[j].ridges[k]] = {static_cast<int>(j), static_cast<int>(k)};
  for (int i = 0; i < static_cast<int>(mesh_.ridges.size()); ++i) {
    const Ridge& ridge = mesh_.ridges[i];
    Link link{i, ridge.cells[0], none, place_of[i].first, place_of[i].second};
    Point other = ridge.center;
    if (ridge.cells.size() == 2) {
      link.second = ridge.cells[1];
      other = mesh_.fracture_cells[link.second].center;
    } else {
      if (ridge.kind != Ridge::Kind::on_boundary) continue;
      Place place = fracture_cell_place(mesh_, link.first);
      place.x = ridge.center;
      const std::optional<OutsideOfRock> outside = outside_of_end(ridge, place, step);
      if (!outside) continue;
      link.boundary_pressure = outside->pressure;
      link.end_conductance = outside->conductance;
      link.only_out = outside->only_out;
      check_bound(link.boundary_pressure, options_.boundary_origins.at(mesh_.side_names[ridge.side]), "the pressure");
    }
    if (!is_in_fracture_cell(link.first) || (link.second != none && !is_in_fracture_cell(link.second))) continue;
    if (!options_.gravity.is_zero())
      link.gravity = options_.fluid_density *
                     options_.gravity.at({ridge.center, 0, 0}).dot(mesh_.fracture_cells[link.first].center - other);
    links_.push_back(link);
  }
}

double FractureFlow::weight_between(const Point& from, const Point& to) const {
  if (options_.gravity.is_zero()) return 0;
  return options_.fluid_density * options_.gravity.at({from, 0, 0}).dot(to - from);
}

void FractureFlow::evaluate_data(const StepTime& step) {
  for (Property* property : {&compressibility_, &inertia_}) property->evaluate(step);
  if (!viscosity_is_given_) viscosity_.evaluate(step);
  for (MeansAlong* means : {&given_transmissivity_, &given_normal_permeability_, &given_wall_permeability_[0],
                            &given_wall_permeability_[1]})
    means->evaluate(step);
  for (MeansAlong& means : transmissivity_of_part_) means.evaluate(step);
  if (formula_) formula_->set_time(step);
  if (history_) history_->show({step.start, step.dt, step.end}, state_remembered());
  make_links(step);
  prescribe(step);
}

void FractureFlow::change_viscosity(const Vector& viscosity) {
  SPREKK_EXPECT(viscosity.size() == mesh_.fracture_cell_count(), viscosity.size(), mesh_.fracture_cell_count());
  viscosity_is_given_ = true;
  if (viscosity_.values() != viscosity) viscosity_.set(viscosity);
}

void FractureFlow::set_search_mode(SearchMode mode) {
  held_aperture_ = mode == SearchMode::piecewise_linear ? aperture_.now() : Vector();
  held_state_.clear();
  for (int i = 0; formula_ && i < held_aperture_.size(); ++i) held_state_.push_back(state_in(i));
  held_flux_ = mode == SearchMode::piecewise_linear && has_inertia() ? flux_.now() : Vector();
  released_share_ = 0;
}

void FractureFlow::release_coefficients(double share) {
  if (share == 0) return set_search_mode(SearchMode::piecewise_linear);
  released_share_ = share;
  if (share == 1) held_aperture_ = held_flux_ = Vector();
}

FractureFlow::Transmissivity FractureFlow::transmissivity(int cell) const {
  if (options_.is_constant()) return {given_transmissivity_[cell] / viscosity_[cell], 0};
  return cubic_law(cell);
}

FractureFlow::Transmissivity FractureFlow::transmissivity(int cell, int ridge) const {
  if (!options_.is_constant()) return cubic_law(cell);
  return {given_transmissivity(cell, ridge) / viscosity_[cell], 0};
}

double FractureFlow::given_transmissivity(int cell, int ridge) const {
  const FractureCell& at = mesh_.fracture_cells[cell];
  const Point& position = mesh_.ridges[ridge].center;
  const auto away = [&](int ridge) { return (mesh_.ridges[ridge].center - position).squaredNorm(); };
  const auto nearest = std::ranges::min_element(at.ridges, [&](int a, int b) { return away(a) < away(b); });
  return transmissivity_of_part_[nearest - at.ridges.begin()][cell];
}

bool FractureFlow::follows_aperture() const {
  return !options_.is_constant() && std::ranges::count(is_prescribed_, 0) > 0;
}

FractureFluid::NormalPermeability FractureFlow::normal_permeability() const {
  const int walls = mesh_.wall_count();
  NormalPermeability kappa{Vector(walls), Vector::Zero(walls)};
  for (int w = 0; w < walls; ++w) {
    const int i = w / 2;
    kappa.value[w] = 0;
    if (!is_in_fracture_cell(i)) continue;
    if (options_.wall_permeability[w % 2]) {
      kappa.value[w] = given_wall_permeability_[w % 2][i];
    } else if (options_.normal_permeability == "constant") {
      kappa.value[w] = given_normal_permeability_[i];
    } else {
      const auto [a, by_present, by_state] = hydraulic_aperture(i);
      const Transmissivity t = transmissivity(i);
      kappa.value[w] = 2 * t.value / (a * a);
      kappa.by_aperture[w] = 2 * t.by_aperture / (a * a) - 4 * t.value / (a * a * a) * by_present;
    }
  }
  return kappa;
}

StoredFluid FractureFlow::stored_fluid(int cell) const {
  return fracture_flow::stored_fluid(filled_accepted(cell), filled_now(cell),
                                     pressure_.now()[cell] - pressure_.accepted()[cell], compressibility_[cell],
                                     entering_density_);
}

void FractureFlow::assemble(Assembly& assembly, const StepTime& step) const {
  assemble_fluxes(assembly, step);
  BalanceRows fluid(assembly, pressure_, "fluid");
  assemble_prescribed_points(assembly, step);
  if (!assembly.has_row(pressure_)) return;
  SPREKK_EXPECT(step.dt > 0, step.dt);
  SPREKK_EXPECT(source_.size() == mesh_.fracture_cell_count(), source_.size(), mesh_.fracture_cell_count());
  const int count = mesh_.fracture_cell_count();
  Vector stored(count), capacity(count), stored_by_aperture(count);
  for (int i = 0; i < count; ++i) {
    const double length = mesh_.fracture_cells[i].measure;
    const StoredFluid fluid_in_cell = stored_fluid(i);
    capacity[i] = length * fluid_in_cell.by_pressure;
    stored_by_aperture[i] = length * fluid_in_cell.by_aperture;
    stored[i] = is_in_fracture_cell(i) ? length * fluid_in_cell.volume : 0;
  }
  // The stored volumes are small differences of large numbers: apertures and pressures.
  double subtracted = 0;
  for (int i = 0; i < count; ++i)
    subtracted = std::max({subtracted, mesh_.fracture_cells[i].measure * std::abs(aperture_.now()[i]),
                           std::abs(capacity[i] * pressure_.now()[i])});
  fluid.store(stored, subtracted);
  assembly.diagonal(pressure_, pressure_, capacity);
  assembly.diagonal(pressure_, aperture_, stored_by_aperture);
  if (empty_) bound_pressure(assembly, stored_by_aperture);
  fluid.supply(step.dt * source_);

  std::vector<Triplet> outflow;
  Vector leaving = Vector::Zero(count);
  for (const Link& link : links_) {
    SPREKK_ASSERT(is_index(link.first, count), link.first, count);
    SPREKK_ASSERT(link.second == none || is_index(link.second, count), link.second, count);
    SPREKK_ASSERT(is_index(link.ridge, flux_.size()), link.ridge, flux_.size());
    outflow.emplace_back(link.first, link.ridge, step.dt);
    if (link.second != none)
      outflow.emplace_back(link.second, link.ridge, -step.dt);
    else
      leaving[link.first] += step.dt * flux_.now()[link.ridge];
  }
  SparseMatrix divergence = matrix_of(count, flux_.size(), outflow);
  // In a steady flow, the residual is the round-off of fluxes that cancel.
  fluid.exchange(divergence * flux_.now(), leaving, step.dt * flux_.now().lpNorm<Eigen::Infinity>());
  assembly.derivative(pressure_, flux_, std::move(divergence));
}

void FractureFlow::constrain(Assembly& assembly) const {
  count_let_in(assembly);
  for (const Prescribed& p : prescribed_) assembly.fix(pressure_, p.cell, p.pressure, p.scale);
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    if (!is_in_fracture_cell(i)) assembly.fix(pressure_, i, 0, mesh_.fracture_cells[i].measure);
}

void FractureFlow::after_solve(const std::vector<Field*>& solved, const StepTime& step) {
  if (std::find(solved.begin(), solved.end(), &pressure_) == solved.end()) return;
  Vector sums = cumulative_.accepted();
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (!is_in_fracture_cell(i)) continue;
    sums[3 * i] += mesh_.fracture_cells[i].measure * stored_fluid(i).volume;
    if (!is_prescribed_[i]) sums[3 * i + 1] += step.dt * source_[i];  // else not solved
  }
  for (std::size_t k = 0; k < prescribed_points_.size(); ++k)
    for (const auto& [cell, share] : prescribed_points_[k].shares)
      sums[3 * cell + 1] += step.dt * share * let_in_at_points_->now()[static_cast<Eigen::Index>(k)];
  for (std::size_t k = 0; k < let_in_.size(); ++k) sums[3 * prescribed_[k].cell + 1] += step.dt * let_in_[k];
  for (const Link& link : links_)
    if (link.second == none) sums[3 * link.first + 2] += step.dt * flux_.now()[link.ridge];
  cumulative_.set(std::move(sums));
  let_in_of_step_ = let_in_;
  if (history_) history_->remember(state_remembered());
}

void FractureFlow::balance(std::map<std::string, Balance>& balances) const {
  Balance& fluid = balances["fluid"];
  fluid.unit = volume_unit;
  add_totals(fluid, mesh_, cumulative_);
}

std::vector<double> FractureFlow::switch_times() const {
  std::vector<double> times = merged_switch_times(properties());
  const auto append = [&](const Data& data) {
    times.insert(times.end(), data.switch_times().begin(), data.switch_times().end());
  };
  for (const auto& [name, injection] : options_.injections) append(injection.rate);
  for (const auto& [name, given] : options_.prescribed) append(given.pressure);
  for (const auto& [side, end] : options_.ends)
    for (const Data* data : end.data()) append(*data);
  return times;
}

void FractureFlow::report(std::vector<Quantity>& quantities) const {
  int floored = 0;
  const bool follows_aperture = !formula_ || formula_->names(of_aperture);
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    const Hydraulic hydraulic = hydraulic_by_law(i, state_in(i));
    if (hydraulic.by_aperture == 0 && (follows_aperture || hydraulic.value <= lowest_)) ++floored;
  }
  quantities.push_back({name() + ".cells_at_aperture_floor", "1", static_cast<double>(floored)});
  report_rates(quantities);
  if (!empty_) return;
  double volume = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) volume += mesh_.fracture_cells[i].measure * empty_->now()[i];
  quantities.push_back({name() + ".empty_volume", volume_unit, volume});
}

}  // namespace sprekk::fracture_flow
