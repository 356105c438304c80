// The rows of the fluxes along fractures: through a ridge between two cells, at an open end, and where fractures meet.
#include <algorithm>
#include <array>

#include "components/fracture_flow/tpfa/flux_rows.hpp"
#include "components/fracture_flow/tpfa/fracture_flow.hpp"
#include "components/fracture_flow/tpfa/half_cell_apertures.hpp"
#include "components/fracture_flow/tpfa/junction_apertures.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/ridge_distance.hpp"

namespace sprekk::fracture_flow {

/// Of half a cell, up to one of its ridges, over the length of that: the resistance to the flow over the inverse of its
/// transmissivity; m in a plane, where flows are per metre.
double FractureFlow::half_length(int cell, int ridge) const {
  return distance_to_ridge(mesh_, cell, ridge) / mesh_.ridges[ridge].measure;
}

Conductance FractureFlow::conductance(const Link& link) const {
  const double half = half_length(link.first, link.ridge);
  if (link.second == none) return conductance_at_end(link);
  if (!options_.is_constant()) return conductance_by_opening(link);
  const double other_half = half_length(link.second, link.ridge);
  const Transmissivity first = transmissivity(link.first, link.ridge), second = transmissivity(link.second, link.ridge);
  if (first.value == 0 || second.value == 0) return {0, {}};
  return {1 / (half / first.value + other_half / second.value), {}};
}

/// Of the half cell, and of what resists at its end: a layer as wide as the fracture is open.
Conductance FractureFlow::conductance_at_end(const Link& link) const {
  const double half = half_length(link.first, link.ridge);
  const Transmissivity first = transmissivity(link.first, link.ridge);
  Conductance open{first.value / half, {{link.first, first.by_aperture / half}}};
  append_by_state(open.by_aperture, link.first, 1 / half, first.by_state);
  if (!link.end_conductance) return open;
  const double width = mesh_.ridges[link.ridge].measure, aperture = aperture_.now()[link.first];
  const bool is_floored = aperture < options_.aperture_floor;
  const double per_aperture = *link.end_conductance * width;
  const double end = per_aperture * (is_floored ? options_.aperture_floor : aperture);
  const double of_end = end > 0 ? end / (open.value + end) : 0, of_open = 1 - of_end;
  for (auto& [cell, by] : open.by_aperture) by *= of_end * of_end;
  if (!is_floored) open.by_aperture.emplace_back(link.first, of_open * of_open * per_aperture);
  open.value *= of_end;
  return open;
}

std::array<FractureFlow::HydraulicHalf, 2> FractureFlow::halves_by_opening(const Link& link) const {
  const auto halves_of = [&](const Vector& aperture) {
    const auto at = [&](int cell) {
      return CellAperture{distance_to_ridge(mesh_, cell, link.ridge), aperture[cell],
                          aperture[cell] - initial_aperture_[cell]};
    };
    return half_cell_apertures(at(link.first), at(link.second));
  };
  const std::array<HalfCellAperture, 2> halves = halves_of(aperture_.now());
  const std::array<HalfCellAperture, 2> held = is_held() ? halves_of(held_aperture_) : halves;
  return {HydraulicHalf{hydraulic_aperture(link.first, halves[0].value, held[0].value), halves[0].by_aperture},
          HydraulicHalf{hydraulic_aperture(link.second, halves[1].value, held[1].value), halves[1].by_aperture}};
}

Conductance FractureFlow::conductance_by_opening(const Link& link) const {
  const std::array<HydraulicHalf, 2> halves = halves_by_opening(link);
  const std::array<int, 2> cells = {link.first, link.second};
  double resistance = 0;
  std::array<double, 2> by_aperture = {0, 0}, by_hydraulic;
  for (int i = 0; i < 2; ++i) {
    const auto& [a, by_present, by_state] = halves[i].hydraulic;
    const double own = 12 * viscosity_[cells[i]] * half_length(cells[i], link.ridge) / (a * a * a);
    resistance += own;
    by_hydraulic[i] = 3 * own / a;
    for (int k = 0; k < 2; ++k) by_aperture[k] -= 3 * own / a * by_present * halves[i].by_aperture[k];
  }
  const double value = 1 / resistance;
  Conductance c{value, {{link.first, -value * value * by_aperture[0]}, {link.second, -value * value * by_aperture[1]}}};
  for (int i = 0; i < 2; ++i)
    append_by_state(c.by_aperture, cells[i], value * value * by_hydraulic[i], halves[i].hydraulic.by_state);
  return c;
}

std::vector<JunctionFluxes> FractureFlow::junction_fluxes() const {
  std::vector<JunctionFluxes> fluxes;
  const Vector walls = walls_of_crossings();
  for (std::size_t j = 0; j < mesh_.junctions.size(); ++j) {
    const Junction& junction = mesh_.junctions[j];
    std::vector<JunctionFluxes::Half> halves =
        options_.is_constant() ? given_halves(junction) : halves_by_opening(junction);
    for (std::size_t k = 0; k < halves.size(); ++k)
      if (!is_in_fracture_cell(junction.cells[k])) halves[k] = {0, no_derivatives(junction)};
    if (has_inertia()) slow_down(junction, halves);
    pass_crossing(j, walls, halves);
    fluxes.emplace_back(junction, mesh_.fracture_cell_count(), std::move(halves));
  }
  return fluxes;
}

Vector FractureFlow::walls_of_crossings() const {
  const bool passes_walls = options_.crossings.find_through() && options_.has_given_walls();
  return passes_walls ? normal_permeability().value : Vector();
}

/// Apertures are those at the start: what fills a crossing does not open. Arms without one, which have grown, and dry
/// ones take no part. `walls`: the normal permeability of each wall; empty where it follows from that along.
void FractureFlow::pass_crossing(std::size_t junction, const Vector& walls,
                                 std::vector<JunctionFluxes::Half>& halves) const {
  const CrossingFill& fill = crossing_fills_[junction];
  if (!fill.is_said() && !options_.is_constant()) return;
  const Junction& at = mesh_.junctions[junction];
  if (fill.through != none && !is_in_fracture_cell(mesh_.fractures[fill.through].first_cell)) {
    // A dry fracture lets nothing through.
    for (JunctionFluxes::Half& half : halves) half = {0, no_derivatives(at)};
    return;
  }
  std::vector<CrossingArm> arms;
  for (const int cell : at.cells) {
    const double width = is_in_fracture_cell(cell) ? initial_aperture_[cell] : 0;
    const double resistivity = options_.is_constant() ? width / given_transmissivity(cell, at.ridges.front()) : 0;
    // The mean of both walls.
    const double across = walls.size() > 0 ? 0.5 * (1 / walls[2 * cell] + 1 / walls[2 * cell + 1]) / viscosity_[cell]
                                           : 0.5 * width * resistivity;
    arms.push_back({mesh_.fracture_cells[cell].fracture, distance_to_ridge(mesh_, cell, at.ridges.front()), width,
                    resistivity, across});
  }
  const std::vector<WayToMiddle> ways = ways_to_middle(arms, fill);
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const WayToMiddle& way = ways[i];
    JunctionFluxes::Half& half = halves[i];
    if (half.value == 0 || (way.kept == 1 && way.added == 0)) continue;
    const double added = way.added / mesh_.ridges[at.ridges.front()].measure;
    const double left = way.kept + half.value * viscosity_[at.cells[i]] * added;
    const double least = drops_.least_kept(at.cells[i], at.ridges.front());
    const double passed = 1 / std::max(left, least);
    const double by_half = left < least ? passed : way.kept * passed * passed;
    half.by_aperture *= by_half;
    for (auto& [ridge, by] : half.by_flux) by *= by_half;
    half.value *= passed;
  }
}

std::vector<JunctionFluxes::Half> FractureFlow::given_halves(const Junction& junction) const {
  std::vector<JunctionFluxes::Half> halves;
  for (const int cell : junction.cells) {
    const double half = half_length(cell, junction.ridges.front());
    halves.push_back({transmissivity(cell, junction.ridges.front()).value / half, no_derivatives(junction)});
  }
  return halves;
}

std::vector<JunctionFluxes::Half> FractureFlow::halves_by_opening(const Junction& junction) const {
  const int count = static_cast<int>(junction.cells.size());
  const auto fracture_of = [&](int place) { return mesh_.fracture_cells[junction.cells[place]].fracture; };
  std::vector<int> partners(count, -1);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      if (i != j && (count == 2 || fracture_of(i) == fracture_of(j))) partners[i] = j;
  const auto arms_of = [&](const Vector& aperture) {
    std::vector<CellAperture> cells;
    for (const int cell : junction.cells) {
      // The opening of a dry arm does not matter for the other arms.
      const double present = is_in_fracture_cell(cell) ? aperture[cell] : initial_aperture_[cell];
      cells.push_back(
          {distance_to_ridge(mesh_, cell, junction.ridges.front()), present, present - initial_aperture_[cell]});
    }
    return junction_apertures(cells, partners);
  };
  const std::vector<ArmAperture> arms = arms_of(aperture_.now());
  const std::vector<ArmAperture> held = is_held() ? arms_of(held_aperture_) : arms;
  std::vector<JunctionFluxes::Half> halves;
  for (int i = 0; i < count; ++i) {
    const auto [a, by_present, by_state] = hydraulic_aperture(junction.cells[i], arms[i].value, held[i].value);
    const double half = half_length(junction.cells[i], junction.ridges.front());
    const double value = a * a * a / (12 * viscosity_[junction.cells[i]] * half);
    halves.push_back({value, no_derivatives(junction)});
    halves.back().by_aperture.head(count) = 3 * value / a * by_present * arms[i].by_aperture;
    for (std::size_t k = 0; k < named_.size(); ++k)
      halves.back().by_aperture[i + count * static_cast<int>(k + 1)] = 3 * value / a * by_state[named_[k]];
  }
  return halves;
}

double FractureFlow::pressure_drop(const Link& link) const {
  const double second = link.second == none ? link.boundary_pressure : pressure_.now()[link.second];
  return pressure_.now()[link.first] - second - link.gravity - varying_weight(link);
}

bool FractureFlow::is_shut(const Link& link) const {
  return link.only_out && pressure_drop(link) - further_drop(link).value < 0;
}

FractureFlow::FurtherDrop FractureFlow::further_drop(const Link& link) const {
  FurtherDrop drop;
  for (const int i : {0, 1}) {
    const int cell = i == 0 ? link.first : link.second;
    if (cell == none) continue;
    const double sign = i == 0 ? 1 : -1;
    const std::vector<std::pair<int, double>> factors = drops_.at(cell, link.ridge);
    if (factors.empty()) continue;
    const Transmissivity t = transmissivity(cell);
    if (t.value == 0) continue;
    // The resistance over a length, and its derivatives; inertia adds beta rho |v|/h^2.
    double resistance = 1 / t.value, by_aperture = -t.by_aperture / (t.value * t.value), inertia = 0;
    ByState by_state = t.by_state;
    for (double& by : by_state) by *= -1 / (t.value * t.value);
    Speed at{0, {}};
    if (has_inertia()) {
      const Hydraulic h = aperture_of_inertia(cell, t);
      at = speed(cell, link.ridge);
      inertia = inertia_[cell] * options_.fluid_density / (h.value * h.value);
      resistance += inertia * at.value;
      by_aperture -= 2 * inertia * at.value / h.value * h.by_aperture;
      for (std::size_t k = 0; k < by_state.size(); ++k) by_state[k] -= 2 * inertia * at.value / h.value * h.by_state[k];
    }
    double own = 0;
    for (const auto& [ridge, factor] : factors) {
      own += sign * factor * flux_.now()[ridge];
      drop.by_flux.emplace_back(ridge, sign * factor * resistance);
    }
    drop.value += own * resistance;
    for (const auto& [ridge, by] : at.by_flux) drop.by_flux.emplace_back(ridge, own * inertia * by);
    if (by_aperture != 0) drop.by_aperture.emplace_back(cell, own * by_aperture);
    append_by_state(drop.by_aperture, cell, own, by_state);
  }
  return drop;
}

/// The columns of the apertures, and those of each further variable of the formula, which may be a sum of fields.
void FractureFlow::derive_by_state(Assembly& assembly, const std::vector<Triplet>& entries) const {
  const int ridges = flux_.size(), count = mesh_.fracture_cell_count();
  const auto derive = [&](int kind, const StateField& by) {
    std::vector<Triplet> own;
    const int components = by.field->spec().components;
    for (const Triplet& entry : entries)
      if (entry.col() / count == kind)
        own.emplace_back(entry.row(), entry.col() % count * components + by.component, by.factor * entry.value());
    assembly.derivative(flux_, *by.field, matrix_of(ridges, by.field->size(), own));
  };
  derive(0, {&aperture_});
  for (std::size_t k = 0; k < named_.size(); ++k)
    for (const StateField& source : state_.of(named_[k])) derive(static_cast<int>(k + 1), source);
}

void FractureFlow::assemble_fluxes(Assembly& assembly, const StepTime& step) const {
  if (!assembly.has_row(flux_)) return;
  const int ridges = flux_.size(), count = mesh_.fracture_cell_count();
  FluxRows rows{step.dt, Vector::Ones(ridges), Vector::Zero(ridges), {}, {}, {}};
  if (density_) find_excess();
  const std::vector<JunctionFluxes> at_junctions = junction_fluxes();
  for (const Link& link : links_) {
    if (link.junction == none) {
      const Conductance c = conductance(link);
      add_row(link, c, rows);
      if (has_inertia()) add_inertia(link, c, rows);
      continue;
    }
    const JunctionFluxes::Flux flux = at_junctions[link.junction].flux(link.place);
    flux.parts.empty() ? add_row(link, flux.conductance, rows) : add_row(link, flux, rows);
    add_pattern(link, rows);
  }
  assembly.add(flux_, rows.of_flux.cwiseProduct(flux_.now()));
  assembly.add(flux_, rows.drop);
  assembly.compare_round_off(flux_, rows.largest_pressure);
  assembly.diagonal(flux_, flux_, rows.of_flux);
  if (!assembly.wants_derivatives()) return;
  assembly.derivative(flux_, pressure_, matrix_of(ridges, count, rows.by_pressure));
  derive_by_state(assembly, rows.by_aperture);
  if (density_) assemble_density(assembly, rows);
  // A closed end has no flux. Its column would have no other entry, and its scale would be free.
  std::vector<char> flows(ridges, false);
  for (const Link& link : links_) flows[link.ridge] = true;
  std::erase_if(rows.by_flux, [&](const Triplet& entry) { return !flows[entry.col()]; });
  if (rows.by_flux.empty()) return;
  assembly.derivative(flux_, flux_, matrix_of(ridges, ridges, rows.by_flux));
}

/// A row is divided by its conductance plus the conductance that corresponds to the storage of a cell: it is then well
/// scaled for sealed and for wide open fractures.
double FractureFlow::scale_of_row(const Link& link, double conductance, double dt) const {
  const FractureCell& first = mesh_.fracture_cells[link.first];
  const double reference = first.measure * initial_aperture_[link.first] * compressibility_[link.first] / dt;
  return conductance + reference > 0 ? 1 / (conductance + reference) : 1;
}

void FractureFlow::add_row(const Link& link, const Conductance& c, FluxRows& rows) const {
  const double scale = scale_of_row(link, c.value, rows.dt);
  const FurtherDrop further = further_drop(link);
  // At an end that lets out only, Q is C times the positive part of the drop.
  const double passes = is_shut(link) ? 0 : 1;
  const double dp = passes * (pressure_drop(link) - further.value), q = flux_.now()[link.ridge];
  rows.of_flux[link.ridge] = scale;
  rows.drop[link.ridge] = -scale * c.value * dp;
  rows.largest_pressure = std::max(rows.largest_pressure, scale * c.value * std::abs(pressure_.now()[link.first]));
  rows.by_pressure.emplace_back(link.ridge, link.first, -passes * scale * c.value);
  if (link.second != none) rows.by_pressure.emplace_back(link.ridge, link.second, scale * c.value);
  for (const auto& [ridge, by] : further.by_flux)
    rows.by_flux.emplace_back(link.ridge, ridge, passes * scale * c.value * by);
  for (const auto& [cell, by] : further.by_aperture)
    rows.by_aperture.emplace_back(link.ridge, cell, passes * scale * c.value * by);
  for (const auto& [cell, weight] : link.by_density)
    rows.by_density.emplace_back(link.ridge, cell, passes * scale * c.value * weight);
  // The derivative of scale (q − C dp) by an aperture, where d scale / da = −scale^2 dC/da.
  for (const auto& [cell, by] : c.by_aperture)
    rows.by_aperture.emplace_back(link.ridge, cell, -scale * by * dp - scale * scale * by * (q - c.value * dp));
  for (const auto& [ridge, by] : c.by_flux)
    rows.by_flux.emplace_back(link.ridge, ridge, -scale * by * dp - scale * scale * by * (q - c.value * dp));
}

/// Adds zero entries wherever any hub would have entries: the hub of a junction may change from one iteration to the
/// next, and the sparsity pattern must not.
void FractureFlow::add_pattern(const Link& link, FluxRows& rows) const {
  const Junction& junction = mesh_.junctions[link.junction];
  for (const int cell : {link.first, link.second}) rows.by_pressure.emplace_back(link.ridge, cell, 0);
  for (const auto& [cell, weight] : link.by_density) rows.by_density.emplace_back(link.ridge, cell, 0);
  for (const int cell : junction.cells)
    for (int k = 0; k < kinds_of_columns(); ++k)
      rows.by_aperture.emplace_back(link.ridge, cell + k * mesh_.fracture_cell_count(), 0);
  for (const int ridge : junction.ridges)
    if (ridge != link.ridge) rows.by_flux.emplace_back(link.ridge, ridge, 0);
  for (const auto& [ridge, by] : further_drop(link).by_flux) rows.by_flux.emplace_back(link.ridge, ridge, 0);
  if (!has_inertia()) return;
  for (const int cell : junction.cells)
    for (const auto& [ridge, by] : speed(cell, link.ridge).by_flux) rows.by_flux.emplace_back(link.ridge, ridge, 0);
}

void FractureFlow::add_row(const Link& link, const JunctionFluxes::Flux& flux, FluxRows& rows) const {
  const double scale = scale_of_row(link, flux.conductance.value, rows.dt);
  double rest = flux_.now()[link.ridge];
  rows.of_flux[link.ridge] = scale;
  for (const auto& [ridge, share] : flux.parts) {
    const double q = flux_.now()[ridge];
    rest -= share.value * q;
    rows.drop[link.ridge] -= scale * share.value * q;
    rows.by_flux.emplace_back(link.ridge, ridge, -scale * share.value);
    for (const auto& [cell, by] : share.by_aperture) rows.by_aperture.emplace_back(link.ridge, cell, -scale * by * q);
    for (const auto& [other, by] : share.by_flux) rows.by_flux.emplace_back(link.ridge, other, -scale * by * q);
  }
  for (const auto& [cell, by] : flux.conductance.by_aperture)
    rows.by_aperture.emplace_back(link.ridge, cell, -scale * scale * by * rest);
  for (const auto& [other, by] : flux.conductance.by_flux)
    rows.by_flux.emplace_back(link.ridge, other, -scale * scale * by * rest);
}

}  // namespace sprekk::fracture_flow
