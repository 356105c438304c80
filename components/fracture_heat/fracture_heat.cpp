#include "components/fracture_heat/fracture_heat.hpp"

#include <algorithm>

#include "components/capabilities/cold.hpp"
#include "components/capabilities/usual_ranges.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/property.hpp"
#include "framework/field/counted_amounts.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/ridge_distance.hpp"

namespace sprekk::fracture_heat {
namespace {

Spec side_spec(Data& temperature) {
  Spec spec("boundary condition of heat in fractures", "For fractures that end on this side.");
  spec.data("temperature", temperature,
            {.unit = "K",
             .doc = "Temperature where fractures meet this side, also of fluid that enters there.",
             .required = true,
             .in_time = true});
  return spec;
}

}  // namespace

Spec Options::spec() {
  Spec spec("fracture_heat/tpfa", "Heat in fractures: conduction along piecewise linear fractures by two points.");
  spec.ignore("type");
  spec.data("aperture", aperture,
            {.unit = "m",
             .range = positive(),
             .doc = "Thickness of what stores and conducts heat at the start: the initial aperture of the flow.",
             .required = true,
             .fixed = "what enters later brings its own heat capacity"});
  usually(spec, "aperture", usual_aperture());
  spec.data("conductivity", conductivity,
            {.unit = "W/(m*K)",
             .range = positive(),
             .doc = "Thermal conductivity of what fills the fracture (water: 0.6 W/(m*K)).",
             .required = true,
             .fixed = "the fluxes are discretized once"});
  usually(spec, "conductivity", usual_conductivity());
  spec.data("heat_capacity", heat_capacity,
            {.unit = "J/(m^3*K)",
             .range = positive(),
             .doc = "Heat capacity per volume of what fills the fracture (water: 4.2e6 J/(m^3*K)).",
             .required = true,
             .fixed = "heat is counted by changes of the temperature"});
  usually(spec, "heat_capacity", usual_fluid_heat_capacity());
  spec.data("initial_temperature", initial_temperature,
            {.unit = "K", .doc = "Temperature at the start.", .fixed = "it is what the run starts from"});
  static Data example;
  spec.named_sections("boundary", side_spec(example),
                      [this](const std::string& side, const Origin& origin) {
                        boundary_origins[side] = origin;
                        return side_spec(boundary[side]);
                      },
                      {.doc = "Temperatures where fractures end on a side; else nothing is conducted there."});
  crossings.declare(spec, "conductivity",
                    {.unit = "W/(m*K)",
                     .range = positive(),
                     .doc = "Thermal conductivity of what fills the crossing; by default the harmonic mean of those of "
                            "the fractures that meet."});
  return spec;
}

FractureHeat::FractureHeat(const ComponentContext& context, const Options& options)
    : Component(context.name),
      mesh_(context.mesh),
      options_(options),
      temperature_(context.fields.add(mesh_, {.owner = context.name,
                                              .name = "temperature",
                                              .location = Location::fracture_cell,
                                              .role = Role::unknown(BlockKind::interface),
                                              .unit = "K",
                                              .doc = "Temperature in the fractures"})),
      cumulative_(context.fields.add(mesh_, amounts_with(temperature_, context.name, "cumulative_heat", energy_unit,
                                                         "Heat stored, and conducted out through ends on sides", 2))) {
  if (mesh_.fracture_cell_count() == 0)
    throw InputError(context.origin, "component '" + context.name + "' has nothing to do", "the scene has no fractures",
                     "add fractures to `geometry:` or remove the component");
  for (const auto& [side, origin] : options_.boundary_origins)
    if (std::find(mesh_.side_names.begin(), mesh_.side_names.end(), side) == mesh_.side_names.end())
      throw unknown_name(origin, "side of the boundary", side, mesh_.side_names);
  const std::vector<Place> places = fracture_cell_places(mesh_);
  const auto values = [&](const Data& data) { return Property(data, places, context.start_time).values(); };
  initial_temperature_ = values(options_.initial_temperature);
  temperature_.set_both(initial_temperature_);
  const Vector aperture = values(options_.aperture), conductivity = values(options_.conductivity);
  thickness_ = aperture;
  capacity_ = values(options_.heat_capacity).cwiseProduct(aperture);
  conductance_along_ = conductivity.cwiseProduct(aperture);
  wall_conductance_.resize(mesh_.wall_count());
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    capacity_[i] *= mesh_.fracture_cells[i].measure;
    wall_conductance_[2 * i] = wall_conductance_[2 * i + 1] = 2 * conductivity[i] / aperture[i];
  }
  capacity_of_temperature_ = Operator(diagonal_matrix(capacity_));
  options_.crossings.check_names(mesh_);
  connect(conductivity.cwiseInverse(), aperture);
}

void FractureHeat::note_input(Notes& notes) const {
  options_.crossings.note_input(mesh_, name(), notes);
  std::vector<const Data*> given;
  for (const auto& [side, temperature] : options_.boundary) given.push_back(&temperature);
  note_cold(notes, name(), initial_temperature_, given);
}

const Data* FractureHeat::end_condition(int point) const {
  const Ridge& at = mesh_.ridges[point];
  if (at.kind != Ridge::Kind::on_boundary) return nullptr;
  const auto found = options_.boundary.find(mesh_.side_names[at.side]);
  return found == options_.boundary.end() ? nullptr : &found->second;
}

std::optional<double> FractureHeat::end_temperature(int point) const {
  if (!end_condition(point)) return std::nullopt;
  return end_temperature_[point];
}

/// Of half a cell, up to one of its ridges, over the length of that; m in a plane.
double FractureHeat::half_length(int cell, int ridge) const {
  return distance_to_ridge(mesh_, cell, ridge) / mesh_.ridges[ridge].measure;
}

double FractureHeat::half_conductance(int cell, int ridge) const {
  return conductance_along_[cell] / half_length(cell, ridge);
}

void FractureHeat::connect(const Vector& resistivity, const Vector& aperture) {
  const int points = static_cast<int>(mesh_.ridges.size()), cells = mesh_.fracture_cell_count();
  conductance_to_end_ = Vector::Zero(points);
  largest_conductance_ = 0;
  for (int cell = 0; cell < cells; ++cell)
    for (const int ridge : mesh_.fracture_cells[cell].ridges)
      largest_conductance_ = std::max(largest_conductance_, half_conductance(cell, ridge));
  std::vector<Triplet> entries, ends;
  const auto join = [&](int first, int second, double conductance) {
    entries.insert(entries.end(), {{first, first, conductance}, {first, second, -conductance}});
    entries.insert(entries.end(), {{second, second, conductance}, {second, first, -conductance}});
  };
  for (int p = 0; p < points; ++p) {
    const Ridge& point = mesh_.ridges[p];
    if (point.kind == Ridge::Kind::junction) continue;
    if (point.cells.size() == 2) {
      const double first = half_conductance(point.cells[0], p), second = half_conductance(point.cells[1], p);
      join(point.cells[0], point.cells[1], first * second / (first + second));
    } else if (end_condition(p)) {
      conductance_to_end_[p] = half_conductance(point.cells[0], p);
      entries.emplace_back(point.cells[0], point.cells[0], conductance_to_end_[p]);
      ends.emplace_back(point.cells[0], point.cells[0], conductance_to_end_[p]);
    }
  }
  // Halves that meet in a point without storage: a star, which is the same as a conductor between each two of them.
  const std::vector<CrossingFill> fills = options_.crossings.fills(mesh_);
  for (std::size_t k = 0; k < mesh_.junctions.size(); ++k) {
    const std::vector<int>& at = mesh_.junctions[k].cells;
    const int ridge = mesh_.junctions[k].ridges.front();
    std::vector<CrossingArm> arms;
    for (const int cell : at) {
      arms.push_back({mesh_.fracture_cells[cell].fracture, half_length(cell, ridge), aperture[cell], resistivity[cell],
                      0.5 * aperture[cell] * resistivity[cell]});
    }
    const std::vector<WayToMiddle> ways = ways_to_middle(arms, fills[k]);
    std::vector<double> halves;
    double sum = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double half = half_conductance(at[i], ridge);
      halves.push_back(half / (ways[i].kept + half * ways[i].added));
      sum += halves[i];
    }
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) join(at[i], at[j], halves[i] * halves[j] / sum);
  }
  SparseMatrix outflow(cells, cells), leaving(cells, cells);
  outflow.setFromTriplets(entries.begin(), entries.end());
  leaving.setFromTriplets(ends.begin(), ends.end());
  outflow_of_temperature_ = Operator(std::move(outflow), std::move(leaving));
}

void FractureHeat::evaluate_data(const StepTime& step) {
  end_temperature_ = Vector::Zero(static_cast<int>(mesh_.ridges.size()));
  for (int p = 0; p < end_temperature_.size(); ++p) {
    const Data* given = end_condition(p);
    if (!given) continue;
    const Ridge& point = mesh_.ridges[p];
    Place place = fracture_cell_place(mesh_, point.cells[0]);
    place.x = point.center;
    end_temperature_[p] = value_in_step(*given, place, step);
  }
}

Vector FractureHeat::leaving() const {
  Vector leaving = Vector::Zero(mesh_.fracture_cell_count());
  for (int p = 0; p < conductance_to_end_.size(); ++p) {
    if (conductance_to_end_[p] == 0) continue;
    const int cell = mesh_.ridges[p].cells[0];
    leaving[cell] += conductance_to_end_[p] * (temperature_.now()[cell] - end_temperature_[p]);
  }
  return leaving;
}

void FractureHeat::assemble(Assembly& assembly, const StepTime& step) const {
  if (!assembly.has_row(temperature_)) return;
  SPREKK_EXPECT(step.dt > 0, step.dt);
  BalanceRows heat(assembly, temperature_, "heat");
  const double largest = temperature_.now().lpNorm<Eigen::Infinity>();
  heat.store(capacity_.cwiseProduct(temperature_.now() - temperature_.accepted()),
             BalanceRows::round_off_of_change * capacity_.lpNorm<Eigen::Infinity>() * largest);
  assembly.derivative(temperature_, temperature_, capacity_of_temperature_);
  Vector outflow = outflow_of_temperature_.entries() * temperature_.now();
  for (int p = 0; p < conductance_to_end_.size(); ++p)
    if (conductance_to_end_[p] != 0) outflow[mesh_.ridges[p].cells[0]] -= conductance_to_end_[p] * end_temperature_[p];
  heat.exchange(step.dt * outflow, step.dt * leaving(), step.dt * largest_conductance_ * largest);
  assembly.derivative(temperature_, temperature_, outflow_of_temperature_, step.dt);
}

void FractureHeat::after_solve(const std::vector<Field*>& solved, const StepTime& step) {
  if (std::find(solved.begin(), solved.end(), &temperature_) == solved.end()) return;
  const Vector leaving = this->leaving();
  Vector sums = cumulative_.accepted();
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    sums[2 * i] += capacity_[i] * (temperature_.now()[i] - temperature_.accepted()[i]);
    sums[2 * i + 1] += step.dt * leaving[i];
  }
  cumulative_.set(std::move(sums));
}

void FractureHeat::balance(std::map<std::string, Balance>& balances) const {
  Balance& heat = balances["heat"];
  heat.unit = energy_unit;
  add_totals(heat, mesh_, cumulative_);
}

std::vector<double> FractureHeat::switch_times() const {
  std::vector<const Data*> data;
  for (const auto& [side, temperature] : options_.boundary) data.push_back(&temperature);
  return merged_switch_times(data);
}

}  // namespace sprekk::fracture_heat
