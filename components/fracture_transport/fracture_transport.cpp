#include "components/fracture_transport/fracture_transport.hpp"

#include <algorithm>
#include <utility>

#include "components/capabilities/cold.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/property.hpp"
#include "framework/field/counted_amounts.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/ridge_distance.hpp"

namespace sprekk::fracture_transport {
FractureTransport::FractureTransport(const ComponentContext& context, const Carried& carried, const Options& options)
    : Component(context.name),
      mesh_(context.mesh),
      carried_(carried),
      options_(options),
      value_(context.fields.add(mesh_, {.owner = context.name,
                                        .name = carried.value,
                                        .location = Location::fracture_cell,
                                        .role = Role::unknown(BlockKind::interface),
                                        .unit = carried.unit,
                                        .doc = capitalized(carried.value) + " in the fractures"})),
      cumulative_(context.fields.add(
          mesh_, amounts_with(value_, context.name, "cumulative_" + carried.quantity, carried.amount_unit,
                              capitalized(carried.quantity) + " stored, and conducted out through ends on sides" +
                                  (options.decay.is_zero() ? "" : " or decayed"),
                              2))) {
  if (mesh_.fracture_cell_count() == 0)
    throw InputError(context.origin, "component '" + context.name + "' has nothing to do", "the scene has no fractures",
                     "add fractures to `geometry:` or remove the component");
  for (const auto& [side, origin] : options_.boundary_origins)
    if (std::find(mesh_.side_names.begin(), mesh_.side_names.end(), side) == mesh_.side_names.end())
      throw unknown_name(origin, "side of the boundary", side, mesh_.side_names);
  const std::vector<Place> places = fracture_cell_places(mesh_);
  const auto values = [&](const Data& data) { return Property(data, places, context.start_time).values(); };
  initial_value_ = values(options_.initial_value);
  value_.set_both(initial_value_);
  const Vector aperture = values(options_.aperture), conductivity = values(options_.conductivity);
  thickness_ = aperture;
  if (!options_.decay.is_zero()) decay_ = values(options_.decay);
  capacity_ = values(options_.capacity).cwiseProduct(aperture);
  conductance_along_ = conductivity.cwiseProduct(aperture);
  wall_conductance_.resize(mesh_.wall_count());
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    capacity_[i] *= mesh_.fracture_cells[i].measure;
    wall_conductance_[2 * i] = wall_conductance_[2 * i + 1] = 2 * conductivity[i] / aperture[i];
  }
  capacity_of_value_ = Operator(diagonal_matrix(capacity_));
  options_.crossings.check_names(mesh_);
  resistivity_ = conductivity.cwiseInverse();
  connect();
}

void FractureTransport::note_input(Notes& notes) const {
  options_.crossings.note_input(mesh_, name(), notes);
  if (!carried_.has_absolute_zero) return;
  std::vector<const Data*> given;
  for (const auto& [side, value] : options_.boundary) given.push_back(&value);
  note_cold(notes, name(), initial_value_, given);
}

const Data* FractureTransport::end_condition(int point) const {
  const Ridge& at = mesh_.ridges[point];
  if (at.kind != Ridge::Kind::on_boundary) return nullptr;
  const auto found = options_.boundary.find(mesh_.side_names[at.side]);
  return found == options_.boundary.end() ? nullptr : &found->second;
}

std::optional<double> FractureTransport::end_value(int point) const {
  if (!end_condition(point)) return std::nullopt;
  return end_value_[point];
}

/// Of half a cell, up to one of its ridges, over the length of that; m in a plane.
double FractureTransport::half_length(int cell, int ridge) const {
  return distance_to_ridge(mesh_, cell, ridge) / mesh_.ridges[ridge].measure;
}

double FractureTransport::half_conductance(int cell, int ridge) const {
  if (added_.empty()) return conductance_along_[cell] / half_length(cell, ridge);
  const Point out = (mesh_.ridges[ridge].center - mesh_.fracture_cells[cell].center).normalized();
  return (conductance_along_[cell] + out.dot(added_[cell] * out)) / half_length(cell, ridge);
}

void FractureTransport::add_conductivity(std::vector<Tensor> added) {
  if (added == added_) return;
  added_ = std::move(added);
  connect();
}

void FractureTransport::connect() {
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
      arms.push_back({mesh_.fracture_cells[cell].fracture, half_length(cell, ridge), thickness_[cell],
                      resistivity_[cell], 0.5 * thickness_[cell] * resistivity_[cell]});
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
  outflow_of_value_ = Operator(matrix_of(cells, cells, entries), matrix_of(cells, cells, ends));
}

void FractureTransport::evaluate_data(const StepTime& step) {
  end_value_ = Vector::Zero(static_cast<int>(mesh_.ridges.size()));
  for (int p = 0; p < end_value_.size(); ++p) {
    const Data* given = end_condition(p);
    if (!given) continue;
    const Ridge& point = mesh_.ridges[p];
    Place place = fracture_cell_place(mesh_, point.cells[0]);
    place.x = point.center;
    end_value_[p] = value_in_step(*given, place, step);
  }
}

Vector FractureTransport::leaving() const {
  Vector leaving = Vector::Zero(mesh_.fracture_cell_count());
  for (int p = 0; p < conductance_to_end_.size(); ++p) {
    if (conductance_to_end_[p] == 0) continue;
    const int cell = mesh_.ridges[p].cells[0];
    leaving[cell] += conductance_to_end_[p] * (value_.now()[cell] - end_value_[p]);
  }
  return leaving;
}

void FractureTransport::assemble(Assembly& assembly, const StepTime& step) const {
  if (!assembly.has_row(value_)) return;
  SPREKK_EXPECT(step.dt > 0, step.dt);
  BalanceRows rows(assembly, value_, carried_.quantity);
  const double largest = value_.now().lpNorm<Eigen::Infinity>();
  rows.store(capacity_.cwiseProduct(value_.now() - value_.accepted()),
             BalanceRows::round_off_of_change * capacity_.lpNorm<Eigen::Infinity>() * largest);
  assembly.derivative(value_, value_, capacity_of_value_);
  Vector outflow = outflow_of_value_.entries() * value_.now();
  for (int p = 0; p < conductance_to_end_.size(); ++p)
    if (conductance_to_end_[p] != 0) outflow[mesh_.ridges[p].cells[0]] -= conductance_to_end_[p] * end_value_[p];
  rows.exchange(step.dt * outflow, step.dt * leaving(), step.dt * largest_conductance_ * largest);
  assembly.derivative(value_, value_, outflow_of_value_, step.dt);
  if (decay_.size() == 0) return;
  const Vector decaying = step.dt * decay_.cwiseProduct(capacity_);
  rows.supply(-decaying.cwiseProduct(value_.now()));
  assembly.diagonal(value_, value_, decaying);
}

void FractureTransport::after_solve(const std::vector<Field*>& solved, const StepTime& step) {
  if (std::find(solved.begin(), solved.end(), &value_) == solved.end()) return;
  const Vector leaving = this->leaving();
  Vector sums = cumulative_.accepted();
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    sums[2 * i] += capacity_[i] * (value_.now()[i] - value_.accepted()[i]);
    sums[2 * i + 1] += step.dt * leaving[i];
    if (decay_.size() > 0) sums[2 * i + 1] += step.dt * decay_[i] * capacity_[i] * value_.now()[i];
  }
  cumulative_.set(std::move(sums));
}

void FractureTransport::balance(std::map<std::string, Balance>& balances) const {
  Balance& balance = balances[carried_.quantity];
  balance.unit = carried_.amount_unit;
  add_totals(balance, mesh_, cumulative_);
}

std::vector<double> FractureTransport::switch_times() const {
  std::vector<const Data*> data;
  for (const auto& [side, value] : options_.boundary) data.push_back(&value);
  return merged_switch_times(data);
}

}  // namespace sprekk::fracture_transport
