// Where fluid is injected into fractures and where their pressure is prescribed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "components/fracture_flow/tpfa/fracture_flow.hpp"
#include "framework/field/ownership.hpp"
#include "framework/mesh/planar.hpp"
#include "framework/mesh/point_location.hpp"
#include "framework/parallel/parallel.hpp"

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
    const FractureCell& cell = mesh_.fracture_cells[cells_of(where).front()];
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

/// A whole fracture takes as much in each metre. At a point, between the centre of a cell and its end on that side, the
/// cell has its share of what lies between both, and all cells that meet at the end the rest, in proportion to the
/// inverse of their lengths: so the mean place of the fluid is the point. Neighbours that have grown, that are not in
/// the flow, or whose pressure is prescribed take none.
std::vector<std::pair<int, double>> FractureFlow::shares_of(const FracturePlace& where) const {
  const std::vector<int> cells = cells_of(where);
  std::vector<std::pair<int, double>> shares;
  if (!where.at) {
    double length = 0;
    for (const int cell : cells) length += mesh_.fracture_cells[cell].measure;
    for (const int cell : cells) shares.emplace_back(cell, mesh_.fracture_cells[cell].measure / length);
    return shares;
  }
  if (cells.empty()) return shares;
  const int home = cells.front();
  if (is_prescribed_[home]) return {{home, 1.0}};  // has no effect, and is noted
  const FractureCell& at = mesh_.fracture_cells[home];
  const auto end_of = [&](int k) -> const FracturePoint& { return mesh_.fracture_points[at.points[k]]; };
  const Point along = (end_of(1).position - end_of(0).position).normalized();
  const double off = (*where.at - at.center).dot(along);
  const FracturePoint& end = end_of(off < 0 ? 0 : 1);
  const double to_end = std::abs(off) / (0.5 * at.measure);  // over 1 by what counts as equally near
  double inverse = 0;
  std::vector<int> meet;
  for (const int cell : cells_at(end)) {
    if (cell != home && (mesh_.fracture_cells[cell].grown || is_prescribed_[cell])) continue;
    meet.push_back(cell);
    inverse += 1 / mesh_.fracture_cells[cell].measure;
  }
  for (const int cell : meet) {
    const double share = to_end / (inverse * mesh_.fracture_cells[cell].measure);
    shares.emplace_back(cell, cell == home ? share + 1 - to_end : share);
  }
  return shares;
}

/// The cells of the flow that meet at the end of one of them: those of a junction, or two, or one.
std::vector<int> FractureFlow::cells_at(const FracturePoint& end) const {
  std::vector<int> cells = end.cells;
  if (end.kind == FracturePoint::Kind::junction)
    for (const Junction& junction : mesh_.junctions)
      for (const int point : junction.points)
        if (&mesh_.fracture_points[point] == &end) cells = junction.cells;
  std::erase_if(cells, [this](int cell) { return !is_in_fracture_cell(cell); });
  return cells;
}

void FractureFlow::prescribe(const StepTime& step) {
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
  source_ = Vector::Zero(mesh_.fracture_cell_count());
  sources_.clear();
  for (const auto& [name, injection] : options_.injections) {
    FluidSource source{name, {}};
    for (const auto& [cell, share] : shares_of(injection.where)) {
      const double rate = value_in_step(injection.rate, fracture_cell_place(mesh_, cell), step) * share;
      source_[cell] += rate;
      source.rates.emplace_back(cell, rate);
    }
    sources_.push_back(std::move(source));
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
    if (injection.where.at)
      quantities.push_back({name() + "." + place_name + ".pressure", "Pa", pressure_at(injection.where, rate)});
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

/// The pressure at a point where fluid is injected. Between two cells the pressure has a kink there: with the shares
/// 1 - s and s, and the conductance C between both centres, it is (1 - s) p_1 + s p_2 + s (1 - s) q/C, exact where all
/// fluid flows along a fracture of one transmissivity. At a crossing it is the mean of the cells.
double FractureFlow::pressure_at(const FracturePlace& where, double rate) const {
  const std::vector<std::pair<int, double>> shares = shares_of(where);
  double pressure = 0;
  for (const auto& [cell, share] : shares) pressure += share * pressure_.now()[cell];
  if (shares.size() != 2) return pressure;
  const std::set<int> both = {shares[0].first, shares[1].first};
  for (const Link& link : links_) {
    if (link.second == none || both != std::set<int>{link.first, link.second}) continue;
    const double between = conductance(link).value;
    if (between > 0) pressure += shares[0].second * shares[1].second * rate / between;
  }
  return pressure;
}

std::vector<FluidReservoir> FractureFlow::fluid_reservoirs() const {
  std::vector<FluidReservoir> reservoirs;
  for (const auto& [name, given] : options_.prescribed) reservoirs.push_back({name, cells_of(given.where)});
  return reservoirs;
}

}  // namespace sprekk::fracture_flow
