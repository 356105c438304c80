#include "components/fracture_flow/tpfa/junction_fluxes.hpp"

#include <algorithm>

namespace sprekk::fracture_flow {
namespace {

using Derivatives = std::vector<std::pair<int, double>>;

void add(double factor, const Derivatives& given, Derivatives& sum) {
  for (const auto& [ridge, by] : given) sum.emplace_back(ridge, factor * by);
}

}  // namespace

JunctionFluxes::JunctionFluxes(const Junction& junction, int fracture_cells, std::vector<Half> halves)
    : junction_(junction), fracture_cells_(fracture_cells), halves_(std::move(halves)) {
  const int count = static_cast<int>(junction_.cells.size());
  for (int i = 0; i < count; ++i) {
    sum_ += halves_[i].value;
    if (halves_[i].value > halves_[hub_].value) hub_ = i;
    for (int j = i + 1; j < count; ++j) ends_.emplace_back(i, j);  // the order of the ridges
  }
}

int JunctionFluxes::ridge_between(int one, int other) const {
  const auto found = std::find(ends_.begin(), ends_.end(), std::pair(std::min(one, other), std::max(one, other)));
  return junction_.ridges[found - ends_.begin()];
}

/// The share of the flux from the hub to `to` in the flux from `from` to `to`.
JunctionFluxes::Flux::Part JunctionFluxes::part(int from, int to, double sign) const {
  if (hub_ > to) sign = -sign;
  const Half &half = halves_[from], &hub = halves_[hub_];
  const double share = sign * half.value / hub.value;
  const Vector by_aperture = (sign * half.by_aperture - share * hub.by_aperture) / hub.value;
  Derivatives by_flux;
  add(sign / hub.value, half.by_flux, by_flux);
  add(-share / hub.value, hub.by_flux, by_flux);
  return {ridge_between(hub_, to), {share, by_cell(by_aperture), by_flux}};
}

std::vector<std::pair<int, double>> JunctionFluxes::by_cell(const Vector& by_aperture) const {
  Derivatives derivatives;
  const auto count = std::ssize(junction_.cells);
  for (Eigen::Index k = 0; k < by_aperture.size(); ++k)
    derivatives.emplace_back(junction_.cells[k % count] + static_cast<int>(k / count) * fracture_cells_,
                             by_aperture[k]);
  return derivatives;
}

JunctionFluxes::Flux JunctionFluxes::flux(int place) const {
  const auto [i, j] = ends_[place];
  Flux flux{{0, {}}, {}};
  if (sum_ == 0) return flux;
  if (i != hub_ && j != hub_) flux.parts = {part(i, j, 1), part(j, i, -1)};
  const double to_i = halves_[i].value / sum_, to_j = halves_[j].value / sum_;
  flux.conductance.value = halves_[i].value * to_j;
  Vector by_aperture = Vector::Zero(halves_.front().by_aperture.size());
  for (int k = 0; k < static_cast<int>(halves_.size()); ++k) {
    const double by = (k == i ? to_j : 0) + (k == j ? to_i : 0) - to_i * to_j;
    by_aperture += by * halves_[k].by_aperture;
    add(by, halves_[k].by_flux, flux.conductance.by_flux);
  }
  flux.conductance.by_aperture = by_cell(by_aperture);
  return flux;
}

}  // namespace sprekk::fracture_flow
