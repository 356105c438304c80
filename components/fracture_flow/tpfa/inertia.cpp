// Forchheimer's law: what inertia adds to the pressure drop of the flow along fractures.
#include <algorithm>
#include <array>
#include <cmath>

#include "components/fracture_flow/tpfa/flux_rows.hpp"
#include "components/fracture_flow/tpfa/fracture_flow.hpp"

namespace sprekk::fracture_flow {

FractureFlow::Speed FractureFlow::speed(int cell, int ridge, const Vector& flux) const {
  const auto out_at = [&](int at) {
    double out = 0;
    for (const auto& [r, sign] : outflows_.at(cell, at)) out += sign * flux[r];
    return out;
  };
  Speed speed{0, {}};
  if constexpr (dimension == 2) {
    const double out = out_at(ridge), by = out == 0 ? 0 : std::copysign(1, out);
    speed.value = std::abs(out);
    for (const auto& [r, sign] : outflows_.at(cell, ridge)) speed.by_flux.emplace_back(r, sign * by);
    return speed;
  }
  // With q the fluxes out of the cell, and M q the drops by them, the mimetic product q·M q is A |v|^2 for a constant
  // v. So (M q) |v| is the gradient of a convex function of q, A/3 |v|^3: there is one answer, in every cell.
  const FractureCell& of = mesh_.fracture_cells[cell];
  double square = 0;
  for (const int at : of.ridges) {
    const double out = out_at(at);
    double drop = half_length(cell, at) * out;
    for (const auto& [r, factor] : drops_.at(cell, at)) drop += factor * flux[r];
    square += out * drop / of.measure;
    for (const auto& [r, sign] : outflows_.at(cell, at)) speed.by_flux.emplace_back(r, sign * drop / of.measure);
  }
  speed.value = std::sqrt(std::max(square, 0.0));
  for (auto& [r, by] : speed.by_flux) by = speed.value > 0 ? by / speed.value : 0;
  return speed;
}

FractureFlow::Speed FractureFlow::speed(int cell, int ridge) const {
  Speed now = speed(cell, ridge, flux_.now());
  if (!is_held()) return now;
  const double held = speed(cell, ridge, held_flux_).value;
  now.value = (1 - released_share_) * held + released_share_ * now.value;
  for (auto& [r, by] : now.by_flux) by *= released_share_;
  return now;
}

FractureFlow::Hydraulic FractureFlow::aperture_of_inertia(int cell, const Transmissivity& transmissivity) const {
  if (options_.is_constant()) return {std::cbrt(12 * viscosity_[cell] * transmissivity.value), 0};
  return hydraulic_aperture(cell);
}

/// I of each half cell, s/m^2 Pa: beta rho L/h^2 over the width of the ridge. With |v| the speed in the cell, and C the
/// conductance: Q (1 + C sum of I |v|) = C (p_first − p_second).
std::array<Conductance, 2> FractureFlow::inertia(const Link& link) const {
  std::array<Conductance, 2> of_halves = {Conductance{0, {}}, Conductance{0, {}}};
  const bool is_by_opening = link.second != none && !options_.is_constant();
  const std::array<HydraulicHalf, 2> halves = is_by_opening ? halves_by_opening(link) : std::array<HydraulicHalf, 2>();
  for (const int i : {0, 1}) {
    const int cell = i == 0 ? link.first : link.second;
    if (cell == none) continue;
    const Hydraulic hydraulic =
        is_by_opening ? halves[i].hydraulic : aperture_of_inertia(cell, transmissivity(cell, link.ridge));
    const double factor = inertia_[cell] * options_.fluid_density * half_length(cell, link.ridge);
    of_halves[i].value = factor / (hydraulic.value * hydraulic.value);
    const double by = -2 * of_halves[i].value / hydraulic.value * hydraulic.by_aperture;
    if (is_by_opening)
      of_halves[i].by_aperture = {{link.first, by * halves[i].by_aperture[0]},
                                  {link.second, by * halves[i].by_aperture[1]}};
    else if (!options_.is_constant())
      of_halves[i].by_aperture = {{cell, by}};
    append_by_state(of_halves[i].by_aperture, cell, -2 * of_halves[i].value / hydraulic.value, hydraulic.by_state);
  }
  return of_halves;
}

void FractureFlow::add_inertia(const Link& link, const Conductance& c, FluxRows& rows) const {
  if (c.value == 0) return;
  const double q = flux_.now()[link.ridge], scale = rows.of_flux[link.ridge];
  const std::array<Conductance, 2> of_halves = inertia(link);
  double drop = 0;
  for (const int i : {0, 1}) {
    const int cell = i == 0 ? link.first : link.second;
    if (cell == none) continue;
    const Speed at = speed(cell, link.ridge);
    const double resistance = of_halves[i].value * at.value;
    drop += resistance * q;
    rows.by_flux.emplace_back(link.ridge, link.ridge, scale * c.value * resistance);
    for (const auto& [ridge, by] : at.by_flux)
      rows.by_flux.emplace_back(link.ridge, ridge, scale * c.value * of_halves[i].value * by * q);
    for (const auto& [other, by] : of_halves[i].by_aperture)
      rows.by_aperture.emplace_back(link.ridge, other, scale * c.value * by * at.value * q);
  }
  rows.drop[link.ridge] += scale * c.value * drop;
  // The scale of the row depends on C as well: d scale / da = −scale^2 dC/da.
  for (const auto& [cell, by] : c.by_aperture)
    rows.by_aperture.emplace_back(link.ridge, cell, scale * (1 - scale * c.value) * by * drop);
}

/// The half cells at a junction have the conductance t/(1 + t I |v|).
void FractureFlow::slow_down(const Junction& junction, std::vector<JunctionFluxes::Half>& halves) const {
  for (std::size_t i = 0; i < halves.size(); ++i) {
    JunctionFluxes::Half& half = halves[i];
    if (half.value == 0) continue;
    const int cell = junction.cells[i];
    const double length = half_length(cell, junction.ridges.front());
    const double h = std::cbrt(12 * viscosity_[cell] * length * half.value);
    const double inertia = inertia_[cell] * options_.fluid_density * length / (h * h);
    const auto [size, by_flux] = speed(cell, junction.ridges.front());
    const double excess = half.value * inertia * size, slower = 1 / (1 + excess);
    for (const auto& [ridge, by] : by_flux)
      half.by_flux.emplace_back(ridge, -half.value * half.value * inertia * slower * slower * by);
    half.by_aperture *= (1 + 2.0 / 3 * excess) * slower * slower;  // I goes with t^(-2/3)
    half.value *= slower;
  }
}

}  // namespace sprekk::fracture_flow
