// What enters a fracture at a point between the centres of cells. To its cell's end on that side, and from there to the
// centres of all cells that meet at the end, the fracture conducts as the fluxes along it have it: with the
// conductances t_k from the centres to the end, r = 1/t_home, and the point at the part s of the way from the centre to
// the end, a rate q at the point is a rate (1 − s) q at the centre and s q at the end, and
//   p = (1 − s) p_home + s p_end + s (1 − s) r q,   p_end = (sum of t_k p_k + s q)/(sum of t_k).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/fracture_flow/tpfa/equivalent_radius.hpp"
#include "components/fracture_flow/tpfa/fracture_flow.hpp"
#include "framework/discretization/along_fracture.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/ridge_distance.hpp"

namespace sprekk::fracture_flow {
namespace {

// Of half a cell: so far beyond its end a point may be its own; as `nearest_fracture_cell` takes cells for equally
// near.
constexpr double equally_near = 2e-6;

}  // namespace

FractureFlow::Spot FractureFlow::spot(int cell, const Point& at) const {
  SPREKK_EXPECT(is_index(cell, mesh_.fracture_cell_count()), cell, mesh_.fracture_cell_count());
  const FractureCell& home = mesh_.fracture_cells[cell];
  const auto end = [&](int k) -> const Point& { return mesh_.ridges[home.ridges[k]].center; };
  const double off = (at - home.center).dot((end(1) - end(0)).normalized());
  const int nearer = home.ridges[off < 0 ? 0 : 1];
  if (mesh_.ridges[nearer].cells.size() == 1) return {nearer, 0};
  return {nearer, std::min(std::abs(off) / distance_to_ridge(mesh_, cell, nearer), 1 + equally_near)};
}

Point FractureFlow::point_at(int cell, const Point& at) const {
  const FractureCell& home = mesh_.fracture_cells[cell];
  return at - home.normal.dot(at - home.center) * home.normal;
}

/// The conductances from the centres of the cells that meet at an end of a cell to this end.
std::vector<FractureFlow::HalfCell> FractureFlow::halves_at(int ridge, int home) const {
  const Ridge& end = mesh_.ridges[ridge];
  std::vector<HalfCell> halves;
  if (end.kind == Ridge::Kind::junction) {
    const auto is_here = [ridge](const Junction& junction) { return std::ranges::count(junction.ridges, ridge) > 0; };
    const auto junction = std::ranges::find_if(mesh_.junctions, is_here);
    const std::vector<JunctionFluxes::Half> own =
        options_.is_constant() ? given_halves(*junction) : halves_by_opening(*junction);
    std::vector<JunctionFluxes::Half> values = own;
    pass_crossing(junction - mesh_.junctions.begin(), walls_of_crossings(), values);
    const auto by_cell = [&](const Vector& by_aperture) {
      std::vector<std::pair<int, double>> derivatives;
      for (Eigen::Index i = 0; i < std::ssize(junction->cells); ++i)
        if (by_aperture[i] != 0) derivatives.emplace_back(junction->cells[i], by_aperture[i]);
      return derivatives;
    };
    for (std::size_t k = 0; k < values.size(); ++k)
      halves.push_back({junction->cells[k], values[k].value, by_cell(values[k].by_aperture), own[k].value,
                        by_cell(own[k].by_aperture)});
  } else if (end.cells.size() == 2 && !options_.is_constant()) {
    const std::array<HydraulicHalf, 2> values = halves_by_opening(Link{ridge, end.cells[0], end.cells[1], none, none});
    for (int k = 0; k < 2; ++k) {
      const int cell = end.cells[k];
      const auto& [a, by_present, by_state] = values[k].hydraulic;
      HalfCell half{cell, a * a * a / (12 * viscosity_[cell] * half_length(cell, ridge)), {}};
      for (int i = 0; i < 2; ++i)
        half.by_aperture.emplace_back(end.cells[i], 3 * half.conductance / a * by_present * values[k].by_aperture[i]);
      halves.push_back(std::move(half));
    }
  } else {
    for (const int cell : end.cells) {
      const auto [value, by_aperture, by_state] = transmissivity(cell, ridge);
      HalfCell half{cell, value / half_length(cell, ridge), {}};
      if (by_aperture != 0) half.by_aperture.emplace_back(cell, by_aperture / half_length(cell, ridge));
      halves.push_back(std::move(half));
    }
  }
  for (HalfCell& half : halves)
    if (end.kind != Ridge::Kind::junction) {
      half.own = half.conductance;
      half.own_by_aperture = half.by_aperture;
    }
  std::erase_if(halves, [&](const HalfCell& half) {
    return half.cell != home && (!is_in_fracture_cell(half.cell) || is_prescribed_[half.cell]);
  });
  return halves;
}

/// At the centre of a cell, or where its pressure is prescribed, or where nothing is conducted, the cell takes all.
bool FractureFlow::is_alone(const Spot& spot, const std::vector<HalfCell>& halves, int home) const {
  const auto own = std::ranges::find(halves, home, &HalfCell::cell);
  SPREKK_ASSERT(own != halves.end(), home);
  return is_prescribed_[home] || spot.to_end == 0 || !(own->conductance > 0);
}

/// The part s of the resistance from the centre to the end, which counts what fills a crossing, that lies before the
/// point. The crossing is at the end itself.
double FractureFlow::part_before(const Spot& spot, const HalfCell& home) {
  return spot.to_end >= 1 - equally_near ? spot.to_end : spot.to_end * home.conductance / home.own;
}

std::vector<std::pair<int, double>> FractureFlow::shares_at(int cell, const Point& at) const {
  std::vector<std::pair<Field*, Vector>> present;
  const auto rewind = [&](Field& field) {
    if (field.now() == field.accepted()) return;
    present.emplace_back(&field, field.now());
    field.set(field.accepted());
  };
  rewind(aperture_);
  for (const std::size_t variable : named_)
    for (const StateField& source : state_.of(variable)) rewind(*source.field);
  std::vector<std::pair<int, double>> shares = present_shares(cell, at);
  for (auto& [field, values] : present) field->set(std::move(values));
  return shares;
}

/// In space, wherever the fracture conducts.
std::vector<std::pair<int, double>> FractureFlow::shares_of_conductors(int cell, const Point& at) const {
  std::vector<std::pair<int, double>> shares = along_fracture(mesh_, cell, at);
  const bool is_alone = std::ranges::any_of(shares, [&](const auto& share) {
    const bool may_be_empty = options_.cavitation && share.second < 0;  // nothing can be taken from there
    return may_be_empty || is_prescribed_[share.first] != 0;
  });
  return is_alone ? std::vector<std::pair<int, double>>{{cell, 1.0}} : shares;
}

std::vector<std::pair<int, double>> FractureFlow::present_shares(int cell, const Point& at) const {
  if constexpr (dimension == 3) {
    std::vector<std::pair<int, double>> shares = shares_of_conductors(cell, point_at(cell, at));
    const bool is_alone =
        std::ranges::any_of(shares, [&](const auto& share) { return transmissivity(share.first).value == 0; });
    return is_alone ? std::vector<std::pair<int, double>>{{cell, 1.0}} : shares;
  }
  const Spot spot = this->spot(cell, at);
  const std::vector<HalfCell> halves = halves_at(spot.end, cell);
  if (is_alone(spot, halves, cell)) return {{cell, 1.0}};
  const double before = part_before(spot, *std::ranges::find(halves, cell, &HalfCell::cell));
  double sum = 0;
  for (const HalfCell& half : halves) sum += half.conductance;
  std::vector<std::pair<int, double>> shares;
  for (const HalfCell& half : halves) {
    const double share = before * half.conductance / sum;
    shares.emplace_back(half.cell, half.cell == cell ? share + 1 - before : share);
  }
  return shares;
}

double FractureFlow::bore_at(const FracturePlace& where, int cell) {
  if constexpr (dimension == 3) {
    if (!where.radius) return 0;
    if (const auto known = bores_.find(&where); known != bores_.end()) return known->second;
    return bores_[&where] = log_of_radii(cell, *where.at, *where.radius, where.origin);
  }
  return 0;
}

double FractureFlow::log_of_radii(int cell, const Point& place, double radius, const Origin& where) const {
  if constexpr (dimension == 3) {
    const Point at = point_at(cell, place);
    const double around = equivalent_radius(mesh_, drops_, cell, at, shares_of_conductors(cell, at));
    if (around == 0)
      throw InputError(
          where, "what a bore hole feels is not known here",
          "the fracture cell at " + to_text(at) + " is at the rim of its fracture, or where it meets others",
          "choose a point that is farther inside, or smaller cells");
    if (around <= radius)
      throw InputError(where, "the fracture cells are too small for the bore hole",
                       fmt::format("those at {} stand for a radius of {:.3g} m", to_text(at), around),
                       "use larger cells there");
    return std::log(around / radius);
  }
  return 0;
}

FractureFluid::Rise FractureFlow::rise_at_bore(int cell, double log_of_radii) const {
  const auto [value, by_aperture, by_state] = transmissivity(cell);
  if (log_of_radii == 0 || value == 0) return {};
  const double rise = log_of_radii / (2 * M_PI * value);
  return {rise, {{cell, -rise / value * by_aperture}}};
}

FractureFluid::Rise FractureFlow::rise_of(const OpenPoint& point) const {
  if constexpr (dimension == 2) return rise_at(point.cell, point.at);
  return rise_at_bore(point.cell, point.bore);
}

FractureFluid::Rise FractureFlow::rise_at(int cell, const Point& at) const {
  if constexpr (dimension == 3) return {};
  const Spot spot = this->spot(cell, at);
  const std::vector<HalfCell> halves = halves_at(spot.end, cell);
  if (is_alone(spot, halves, cell)) return {};
  const HalfCell& home = *std::ranges::find(halves, cell, &HalfCell::cell);
  double sum = 0;
  for (const HalfCell& half : halves) sum += half.conductance;
  const double s = part_before(spot, home), t = home.conductance;
  Rise rise{s * (1 - s) / t + s * s / sum};
  const auto add = [&rise](double by, const std::vector<std::pair<int, double>>& conductance_by_aperture) {
    for (const auto& [of, by_aperture] : conductance_by_aperture) rise.by_aperture.emplace_back(of, by * by_aperture);
  };
  for (const HalfCell& half : halves) add(-s * s / (sum * sum), half.by_aperture);
  add(-s * (1 - s) / (t * t), home.by_aperture);
  if (s == spot.to_end) return rise;
  const double by_s = (1 - 2 * s) / t + 2 * s / sum;
  add(by_s * s / t, home.by_aperture);
  add(-by_s * s / home.own, home.own_by_aperture);
  return rise;
}

}  // namespace sprekk::fracture_flow
