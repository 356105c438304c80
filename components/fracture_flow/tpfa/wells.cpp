// Where fluid is injected into fractures and where their pressure is prescribed.
#include <fmt/format.h>

#include <algorithm>

#include "components/fracture_flow/tpfa/fracture_flow.hpp"
#include "framework/field/ownership.hpp"
#include "framework/mesh/planar.hpp"
#include "framework/mesh/point_location.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::fracture_flow {

namespace {

/// The nearest cell that has not grown.
int nearest_original_cell(const Mesh& mesh, int fracture, const Point& x) {
  const int nearest = nearest_fracture_cell(mesh, fracture, x);
  if (!mesh.fracture_cells[nearest].grown) return nearest;
  // What has grown lies at the ends: the first or the last of the others.
  const auto& [name, first, count] = mesh.fractures[fracture];
  int low = first, high = first + count - 1;
  while (mesh.fracture_cells[low].grown) ++low;
  while (mesh.fracture_cells[high].grown) --high;
  return nearest < low ? low : high;
}

/// A place, or a whole fracture, stays what it was at the start of the run: cells that have grown do not belong to it.
std::vector<int> cells_at(const Mesh& mesh, const FracturePlace& where) {
  std::vector<int> cells;
  if (where.at) {
    int nearest = none;
    for (int f = 0; f < static_cast<int>(mesh.fractures.size()); ++f) {
      if (!where.fracture.empty() && mesh.fractures[f].name != where.fracture) continue;
      const int candidate = nearest_original_cell(mesh, f, *where.at);
      const auto distance = [&](int cell) { return (mesh.fracture_cells[cell].center - *where.at).norm(); };
      if (nearest == none || distance(candidate) < distance(nearest)) nearest = candidate;
    }
    return {nearest};
  }
  for (int i = 0; i < mesh.fracture_cell_count(); ++i)
    if (!mesh.fracture_cells[i].grown &&
        (where.fracture.empty() || mesh.fractures[mesh.fracture_cells[i].fracture].name == where.fracture))
      cells.push_back(i);
  return cells;
}

}  // namespace

void FractureFlow::check_names() const {
  std::vector<std::string> names;
  for (const Fracture& fracture : mesh_.fractures) names.push_back(fracture.name);
  const auto check = [&](const FracturePlace& where) {
    if (!where.fracture.empty() && find_fracture(mesh_, where.fracture) == none)
      throw unknown_name(where.origin, "fracture", where.fracture, names);
    if (cells_of(where).empty())
      throw InputError(where.origin, "there is no flow at this place", "its fracture is not one of 'fractures'",
                       "name the fracture there, or choose another place");
    if (!where.at) return;
    const FractureCell& cell = mesh_.fracture_cells[cells_at(mesh_, where).front()];
    const double away = (cell.center - *where.at).norm();
    if (away > cell.measure)
      throw InputError(where.origin, "there is no fracture at this place",
                       "the nearest cell is " + fmt::format("{:.3g} m", away) + " away and only " +
                           fmt::format("{:.3g} m", cell.measure) + " long",
                       "choose a point on a fracture");
  };
  for (const auto& [name, injection] : options_.injections) check(injection.where);
  std::vector<const std::string*> prescribed_by(mesh_.fracture_cell_count(), nullptr);
  for (const auto& [name, prescribed] : options_.prescribed) {
    check(prescribed.where);
    for (const int cell : cells_of(prescribed.where)) {
      if (prescribed_by[cell])
        throw InputError(prescribed.where.origin, "'" + name + "' prescribes a pressure where there is one",
                         "'" + *prescribed_by[cell] + "' gives the same fracture cell at " +
                             to_text(mesh_.fracture_cells[cell].center) + " a pressure",
                         "let each cell be in one of them");
      prescribed_by[cell] = &name;
    }
  }
  for (const auto& [side, origin] : options_.boundary_origins)
    if (std::find(mesh_.side_names.begin(), mesh_.side_names.end(), side) == mesh_.side_names.end())
      throw unknown_name(origin, "side of the boundary", side, mesh_.side_names);
}

std::vector<int> FractureFlow::cells_of(const FracturePlace& where) const {
  std::vector<int> cells = cells_at(mesh_, where);
  std::erase_if(cells, [this](int cell) { return !is_in_fracture_cell(cell); });
  return cells;
}

void FractureFlow::prescribe(const StepTime& step) {
  source_ = Vector::Zero(mesh_.fracture_cell_count());
  sources_.clear();
  for (const auto& [name, injection] : options_.injections) {
    const std::vector<int> cells = cells_of(injection.where);
    FluidSource source{name, {}};
    double length = 0;
    for (const int cell : cells) length += mesh_.fracture_cells[cell].measure;
    for (const int cell : cells) {
      const FractureCell& at = mesh_.fracture_cells[cell];
      const double rate = value_in_step(injection.rate, fracture_cell_place(mesh_, cell), step) * at.measure / length;
      source_[cell] += rate;
      source.rates.emplace_back(cell, rate);
    }
    sources_.push_back(std::move(source));
  }
  prescribed_.clear();
  let_in_.clear();
  step_length_ = step.dt;
  is_prescribed_.assign(mesh_.fracture_cell_count(), 0);
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) is_prescribed_[i] = !is_in_fracture_cell(i);
  for (const auto& [name, given] : options_.prescribed)
    for (const int cell : cells_of(given.where)) {
      const FractureCell& at = mesh_.fracture_cells[cell];
      is_prescribed_[cell] = 1;
      check_bound(value_in_step(given.pressure, fracture_cell_place(mesh_, cell), step), given.where.origin,
                  "the pressure");
      const double storage = at.measure * initial_aperture_[cell] * compressibility_[cell];
      prescribed_.push_back({cell, value_in_step(given.pressure, fracture_cell_place(mesh_, cell), step),
                             storage > 0 ? storage : at.measure});
    }
  // The balance of a cell with a prescribed pressure is not solved: what is injected there has no effect.
  for (FluidSource& source : sources_)
    std::erase_if(source.rates, [&](const auto& rate) { return is_prescribed_[rate.first] != 0; });
}

/// The flow into the fracture at a cell with a prescribed pressure: the residual of its balance, before its row is
/// replaced.
void FractureFlow::count_let_in(const Assembly& assembly) const {
  const std::vector<const Field*>& unknowns = assembly.unknowns();
  const auto found = std::ranges::find(unknowns, &pressure_);
  if (found == unknowns.end()) return;
  const Vector& lacks = assembly.residual(static_cast<int>(found - unknowns.begin()));
  let_in_.resize(prescribed_.size());
  for (std::size_t k = 0; k < prescribed_.size(); ++k) {
    const int cell = prescribed_[k].cell;
    let_in_[k] = lacks[cell] / step_length_ + source_[cell];  // an injection there has no effect
  }
}

void FractureFlow::report_rates(std::vector<Quantity>& quantities) const {
  for (const auto& [place_name, injection] : options_.injections) {
    double rate = 0;
    for (const FluidSource& source : sources_)
      if (source.name == place_name)
        for (const auto& [cell, part] : source.rates) rate += part;
    quantities.push_back({name() + "." + place_name + ".rate", "m^2/s", rate});
  }
  if (options_.prescribed.empty() && options_.boundary.empty()) return;
  Vector rates = Vector::Zero(static_cast<Eigen::Index>(options_.prescribed.size()));
  std::size_t k = 0;
  Eigen::Index place = 0;
  for (const auto& [place_name, given] : options_.prescribed) {
    const std::size_t count = cells_of(given.where).size();
    for (std::size_t i = 0; i < count && k < let_in_.size(); ++i, ++k)
      if (is_owned(mesh_, Location::fracture_cell, prescribed_[k].cell)) rates[place] += let_in_[k];
    ++place;
  }
  parallel::sum(rates);
  place = 0;
  for (const auto& [place_name, given] : options_.prescribed)
    quantities.push_back({name() + "." + place_name + ".rate", "m^2/s", rates[place++]});
  for (const auto& [side, pressure] : options_.boundary) {
    double outflow = 0;  // fluxes are whole on every process
    for (const Link& link : links_) {
      const int of_link = mesh_.fracture_points[link.point].side;
      if (link.second == none && of_link != none && mesh_.side_names[of_link] == side)
        outflow += flux_.now()[link.point];
    }
    quantities.push_back({name() + "." + side + ".outflow", "m^2/s", outflow});
  }
}

std::vector<FluidReservoir> FractureFlow::fluid_reservoirs() const {
  std::vector<FluidReservoir> reservoirs;
  for (const auto& [name, given] : options_.prescribed) reservoirs.push_back({name, cells_of(given.where)});
  return reservoirs;
}

}  // namespace sprekk::fracture_flow
