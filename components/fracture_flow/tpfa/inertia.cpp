// Forchheimer's law: what inertia adds to the pressure drop of the flow along fractures.
#include <array>
#include <cmath>

#include "components/fracture_flow/tpfa/flux_rows.hpp"
#include "components/fracture_flow/tpfa/fracture_flow.hpp"

namespace sprekk::fracture_flow {

std::array<double, 2> FractureFlow::size_of_flux(double now, double held) const {
  const double share = is_held() ? released_share_ : 1;
  const double by_now = now == 0 ? 0 : std::copysign(share, now);
  return {(1 - share) * std::abs(held) + share * std::abs(now), by_now};
}

/// C I, s/m^2, with I the sum of beta rho L/(2 h^2) over the half cells: Q (1 + C I |Q|) = C (p_first − p_second).
Conductance FractureFlow::inertia(const Link& link) const {
  double sum = 0;
  std::vector<std::pair<int, double>> by_aperture;
  const bool is_by_opening = link.second != none && !options_.is_constant();
  const std::array<HydraulicHalf, 2> halves = is_by_opening ? halves_by_opening(link) : std::array<HydraulicHalf, 2>();
  for (const int i : {0, 1}) {
    const int cell = i == 0 ? link.first : link.second;
    if (cell == none) continue;
    const double width = mesh_.ridges[link.ridge].measure;
    const double factor = inertia_[cell] * options_.fluid_density * half_length(cell, link.ridge) / width;
    HydraulicAperture hydraulic = halves[i].hydraulic;
    if (!is_by_opening) hydraulic = hydraulic_aperture(cell);
    if (options_.is_constant())
      hydraulic = {std::cbrt(12 * viscosity_[cell] * transmissivity(cell, link.ridge).value), 0};
    const double own = factor / (hydraulic.value * hydraulic.value);
    sum += own;
    const double by = -2 * own / hydraulic.value * hydraulic.by_aperture;
    if (is_by_opening) {
      by_aperture.emplace_back(link.first, by * halves[i].by_aperture[0]);
      by_aperture.emplace_back(link.second, by * halves[i].by_aperture[1]);
    } else if (!options_.is_constant()) {
      by_aperture.emplace_back(cell, by);
    }
  }
  return {sum, std::move(by_aperture)};
}

void FractureFlow::add_inertia(const Link& link, const Conductance& c, FluxRows& rows) const {
  if (c.value == 0) return;
  const double q = flux_.now()[link.ridge], scale = rows.of_flux[link.ridge];
  const auto [size, by_flux] = size_of_flux(q, is_held() ? held_flux_[link.ridge] : q);
  const Conductance of_halves = inertia(link);
  rows.drop[link.ridge] += scale * c.value * of_halves.value * size * q;
  rows.by_flux.emplace_back(link.ridge, link.ridge, scale * c.value * of_halves.value * (size + by_flux * q));
  for (const auto& [cell, by] : of_halves.by_aperture)
    rows.by_aperture.emplace_back(link.ridge, cell, scale * c.value * by * size * q);
  // The scale of the row depends on C as well: d scale / da = −scale^2 dC/da.
  for (const auto& [cell, by] : c.by_aperture)
    rows.by_aperture.emplace_back(link.ridge, cell, scale * (1 - scale * c.value) * by * of_halves.value * size * q);
}

/// The half cells at a junction have the conductance t/(1 + t I |q|), with q what flows out of the cell.
void FractureFlow::slow_down(const Junction& junction, std::vector<JunctionFluxes::Half>& halves) const {
  const int count = static_cast<int>(halves.size());
  Vector out = Vector::Zero(count), held = Vector::Zero(count);
  int place = 0;
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j, ++place) {
      const int point = junction.ridges[place];
      out[i] += flux_.now()[point];
      out[j] -= flux_.now()[point];
      if (!is_held()) continue;
      held[i] += held_flux_[point];
      held[j] -= held_flux_[point];
    }
  for (int i = 0; i < count; ++i) {
    JunctionFluxes::Half& half = halves[i];
    if (half.value == 0) continue;
    const int cell = junction.cells[i];
    const double length = half_length(cell, junction.ridges.front());
    const double h = std::cbrt(12 * viscosity_[cell] * length * half.value);
    const double width = mesh_.ridges[junction.ridges.front()].measure;
    const double inertia = inertia_[cell] * options_.fluid_density * length / width / (h * h);
    const auto [size, by_outflow] = size_of_flux(out[i], held[i]);
    const double excess = half.value * inertia * size, slower = 1 / (1 + excess);
    half.by_outflow = -half.value * half.value * inertia * by_outflow * slower * slower;
    half.by_aperture *= (1 + 2.0 / 3 * excess) * slower * slower;  // I goes with t^(-2/3)
    half.value *= slower;
  }
}

}  // namespace sprekk::fracture_flow
