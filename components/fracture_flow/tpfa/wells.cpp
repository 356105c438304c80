// Where fluid is injected into fractures and where their pressure is prescribed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/fracture_flow/tpfa/fracture_flow.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/search/distances.hpp"
#include "framework/mesh/search/point_location.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk::fracture_flow {

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
    const int cell = cells_of(where).front();
    const double away = distance_to_fracture_cell(mesh_, cell, *where.at);
    if (away > mesh_.fracture_cells[cell].size())
      throw InputError(where.origin, "there is no fracture at this place",
                       fmt::format("the nearest one is {:.3g} m away", away), "choose a point on a fracture");
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
  check_points_apart();
  for (const auto& [side, origin] : options_.boundary_origins)
    if (std::find(mesh_.side_names.begin(), mesh_.side_names.end(), side) == mesh_.side_names.end())
      throw unknown_name(origin, "side of the boundary", side, mesh_.side_names);
}

/// The pressure between two points with prescribed pressures is not resolved where both lie between the same centres.
void FractureFlow::check_points_apart() const {
  struct Taken {
    const std::string* name;
    Point end;
  };
  std::vector<Taken> taken;
  for (const auto& [name, given] : options_.prescribed) {
    if (!given.where.at) continue;
    const int cell = cells_of(given.where).front();
    Point position = *given.where.at;
    if constexpr (dimension == 2) {
      const auto [end, to_end] = spot(cell, position);
      if (to_end < rounding::far_above) continue;
      position = mesh_.ridges[end].center;
    }
    for (const Taken& other : taken)
      if ((other.end - position).norm() < rounding::far_above * mesh_.fracture_cells[cell].size())
        throw InputError(given.where.origin, "'" + name + "' prescribes a pressure where there is one",
                         "'" + *other.name + "' gives " +
                             (dimension == 2 ? "a point one that lies between the same centres of cells, around "
                                             : "one to the same point, ") +
                             to_text(position),
                         "use smaller cells there, or remove one of the two");
    taken.push_back({&name, position});
  }
}

/// A place, or a whole fracture, stays what it was at the start of the run: cells that have grown do not belong to it.
std::vector<int> FractureFlow::cells_of(const FracturePlace& where) const {
  const auto counts = [&](int cell) {
    const FractureCell& at = mesh_.fracture_cells[cell];
    return !at.grown && is_in_fracture_cell(cell) &&
           (where.fracture.empty() || mesh_.fractures[at.fracture].name == where.fracture);
  };
  std::vector<int> cells;
  if (where.at) {
    const int nearest = nearest_fracture_cell(mesh_, *where.at, counts);
    if (nearest != none) cells.push_back(nearest);
    return cells;
  }
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    if (counts(i)) cells.push_back(i);
  return cells;
}

/// A whole fracture takes as much in each metre.
std::vector<std::pair<int, double>> FractureFlow::shares_by_length(const FracturePlace& where) const {
  const std::vector<int> cells = cells_of(where);
  double length = 0;
  for (const int cell : cells) length += mesh_.fracture_cells[cell].measure;
  std::vector<std::pair<int, double>> shares;
  for (const int cell : cells) shares.emplace_back(cell, mesh_.fracture_cells[cell].measure / length);
  return shares;
}

void FractureFlow::find_prescribed_cells() {
  is_prescribed_.assign(mesh_.fracture_cell_count(), 0);
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) is_prescribed_[i] = !is_in_fracture_cell(i);
  for (const auto& [name, given] : options_.prescribed)
    if (!given.where.at)
      for (const int cell : cells_of(given.where)) is_prescribed_[cell] = 1;
}

void FractureFlow::prescribe(const StepTime& step) {
  prescribed_.clear();
  let_in_.clear();
  step_length_ = step.dt;
  prescribed_points_.clear();
  for (const auto& [name, given] : options_.prescribed)
    for (const int cell : cells_of(given.where)) {
      const double pressure = value_in_step(given.pressure, fracture_cell_place(mesh_, cell), step);
      check_bound(pressure, given.where.origin, "the pressure");
      if (given.where.at) {
        prescribed_points_.push_back(
            {.name = name, .cell = cell, .at = *given.where.at, .value = pressure, .bore = bore_at(given.where, cell)});
        continue;
      }
      const FractureCell& at = mesh_.fracture_cells[cell];
      const double storage = at.measure * initial_aperture_[cell] * compressibility_[cell];
      prescribed_.push_back({cell, pressure, storage > 0 ? storage : at.measure});
    }
  source_ = Vector::Zero(mesh_.fracture_cell_count());
  sources_.clear();
  injected_points_.clear();
  for (const auto& [name, injection] : options_.injections) {
    FluidSource source{name, {}};
    const auto rate = [&, &injection = injection](int cell) {
      return value_in_step(injection.rate, fracture_cell_place(mesh_, cell), step);
    };
    if (injection.where.at) {
      const int cell = cells_of(injection.where).front();
      injected_points_.push_back({.name = name,
                                  .cell = cell,
                                  .at = *injection.where.at,
                                  .value = rate(cell),
                                  .bore = bore_at(injection.where, cell)});
    } else {
      for (const auto& [cell, share] : shares_by_length(injection.where))
        source.rates.emplace_back(cell, rate(cell) * share);
    }
    sources_.push_back(std::move(source));
  }
}

/// Finds the shares of points in this step, and what enters each cell.
void FractureFlow::share_points() {
  for (OpenPoint& point : prescribed_points_) share(point, true);
  for (OpenPoint& point : injected_points_) {
    share(point, false);
    FluidSource& source = *std::ranges::find(sources_, point.name, &FluidSource::name);
    source.rates.clear();
    source.is_shared = true;
    for (const auto& [cell, share] : point.shares) source.rates.emplace_back(cell, point.value * share);
  }
  source_.setZero();
  for (FluidSource& source : sources_) {
    for (const auto& [cell, rate] : source.rates) source_[cell] += rate;
    // The balance of a cell with a prescribed pressure is not solved: what is injected there has no effect.
    std::erase_if(source.rates, [&](const auto& rate) { return is_prescribed_[rate.first] != 0; });
  }
}

void FractureFlow::share(OpenPoint& point, bool is_given_pressure) const {
  // In space a pressure without a bore hole is that of its cell: a mean of cells that the walls hold apart could be
  // kept only by one that is beyond it.
  const bool is_of_cell = dimension == 3 && is_given_pressure && point.bore == 0;
  point.shares = is_of_cell ? decltype(point.shares){{point.cell, 1.0}} : shares_at(point.cell, point.at);
  point.level = 0;
  const Point place = point_at(point.cell, point.at);
  for (const auto& [cell, share] : point.shares)
    point.level += share * weight_between(mesh_.fracture_cells[cell].center, place);
}

std::vector<FluidSource> FractureFlow::fluid_sources() const {
  std::vector<FluidSource> sources = sources_;
  for (std::size_t k = 0; k < prescribed_points_.size(); ++k) {
    const double rate = let_in_at_points_->now()[static_cast<Eigen::Index>(k)];
    sources.push_back({prescribed_points_[k].name, {}, true});
    for (const auto& [cell, share] : prescribed_points_[k].shares)
      sources.back().rates.emplace_back(cell, share * rate);
  }
  return sources;
}

/// The rate q that a point with the prescribed pressure P lets in: into the balances of its cells with their shares, so
/// that P is the pressure at the point.
void FractureFlow::assemble_prescribed_points(Assembly& assembly, const StepTime& step) const {
  if (prescribed_points_.empty()) return;
  const Field& rate = *let_in_at_points_;
  const int count = rate.size(), cells = mesh_.fracture_cell_count();
  std::vector<Triplet> shares, into, by_aperture;
  Vector of_rate = Vector::Zero(count), given = Vector::Zero(count);
  for (int k = 0; k < count; ++k) {
    const OpenPoint& point = prescribed_points_[k];
    for (const auto& [cell, share] : point.shares) {
      shares.emplace_back(k, cell, share);
      into.emplace_back(cell, k, -step.dt * share);
    }
    const Rise rise = rise_of(point);
    of_rate[k] = rise.value;
    given[k] = point.value - point.level;
    for (const auto& [cell, by] : rise.by_aperture) by_aperture.emplace_back(k, cell, by * rate.now()[k]);
  }
  const auto matrix = [](const std::vector<Triplet>& entries, int rows, int columns) {
    return matrix_of(rows, columns, entries);
  };
  if (assembly.has_row(pressure_)) {
    SparseMatrix of_cells = matrix(into, cells, count);
    BalanceRows(assembly, pressure_).supply(-(of_cells * rate.now()));
    assembly.derivative(pressure_, rate, std::move(of_cells));
  }
  if (!assembly.has_row(rate)) return;
  SparseMatrix of_cells = matrix(shares, count, cells);
  assembly.add(rate, of_cells * pressure_.now());
  assembly.add(rate, of_rate.cwiseProduct(rate.now()));
  assembly.add(rate, -given);
  assembly.derivative(rate, pressure_, std::move(of_cells));
  assembly.diagonal(rate, rate, of_rate);
  if (!by_aperture.empty()) assembly.derivative(rate, aperture_, matrix(by_aperture, count, cells));
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
  for (const FluidSource& source : sources_) {
    double rate = 0;
    for (const auto& [cell, part] : source.rates) rate += part;
    quantities.push_back({name() + "." + source.name + ".rate", volume_rate_unit, rate});
    const auto point = std::ranges::find(injected_points_, source.name, &OpenPoint::name);
    if (point != injected_points_.end())
      quantities.push_back({name() + "." + source.name + ".pressure", "Pa", pressure_at(*point, rate)});
  }
  if (options_.prescribed.empty() && options_.ends.empty()) return;
  Vector rates = Vector::Zero(static_cast<Eigen::Index>(options_.prescribed.size()));
  std::size_t k = 0;
  Eigen::Index place = 0;
  for (const auto& [place_name, given] : options_.prescribed) {
    const std::size_t count = given.where.at ? 0 : cells_of(given.where).size();
    for (std::size_t i = 0; i < count && k < let_in_of_step_.size(); ++i, ++k)
      if (is_owned(mesh_, Location::fracture_cell, prescribed_[k].cell)) rates[place] += let_in_of_step_[k];
    ++place;
  }
  parallel::sum(rates);
  place = 0;
  Eigen::Index point = 0;
  for (const auto& [place_name, given] : options_.prescribed) {
    const double rate = given.where.at ? let_in_at_points_->now()[point++] : rates[place];
    quantities.push_back({name() + "." + place_name + ".rate", volume_rate_unit, rate});
    ++place;
  }
  for (const auto& [side, end] : options_.ends) {
    if (end.is_closed) continue;
    double outflow = 0;  // fluxes are whole on every process
    for (const Link& link : links_) {
      const int of_link = mesh_.ridges[link.ridge].side;
      if (link.second == none && of_link != none && mesh_.side_names[of_link] == side)
        outflow += flux_.now()[link.ridge];
    }
    quantities.push_back({name() + "." + side + ".outflow", volume_rate_unit, outflow});
  }
}

/// The pressure at a point where fluid is injected, which has a kink there.
double FractureFlow::pressure_at(const OpenPoint& point, double rate) const {
  double pressure = point.level + rise_of(point).value * rate;
  for (const auto& [cell, share] : point.shares) pressure += share * pressure_.now()[cell];
  return pressure;
}

std::vector<FluidReservoir> FractureFlow::fluid_reservoirs() const {
  std::vector<FluidReservoir> reservoirs;
  for (const auto& [name, given] : options_.prescribed)
    if (!given.where.at) reservoirs.push_back({name, cells_of(given.where)});
  return reservoirs;
}

}  // namespace sprekk::fracture_flow
