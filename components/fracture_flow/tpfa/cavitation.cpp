// Fractures in which fluid cannot follow: the pressure has a lower bound p_c, and a part e of the aperture is empty,
//   p >= p_c,  e >= 0,  (p − p_c) e = 0
// in each cell: the condition of Elrod and Adams (1974) in the form of a complementarity (Giacopini et al., J.
// Tribology 132, 2010, 041702), and that of the lag at the tip of a hydraulic fracture (Peirce and Detournay, Comput.
// Methods Appl. Mech. Engrg. 197 (2008) 2858). A cell holds fluid in a − e of its aperture: the balance of fluid is
// that of full cells. Between cells at the bound nothing flows, as their pressures are equal, and what flows into one
// fills it.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "components/fracture_flow/tpfa/fracture_flow.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk::fracture_flow {

void FractureFlow::check_bound(double pressure, const Origin& where, const std::string& what) const {
  if (!options_.cavitation || pressure >= *options_.cavitation) return;
  throw InputError(where, fmt::format("{} is below the bound of '{}'", what, name()),
                   fmt::format("it is {:.6g} Pa, and 'cavitation' keeps pressures at {:.6g} Pa or more", pressure,
                               *options_.cavitation),
                   "lower 'cavitation', or raise the pressure");
}

/// Whether the condition of the cell is p = p_c; otherwise it is e = 0. The scale decides which of the two is taken
/// while neither holds; the solution does not depend on it.
bool FractureFlow::is_partly_empty(int cell) const {
  return empty_ && empty_->now()[cell] > bound_scale_ * (pressure_.now()[cell] - *options_.cavitation);
}

void FractureFlow::bound_pressure(Assembly& assembly, const Vector& stored_by_filled) const {
  const int count = mesh_.fracture_cell_count();
  assembly.diagonal(pressure_, *empty_, -stored_by_filled);
  if (!assembly.has_row(*empty_)) return;
  Vector residual(count), by_empty(count), by_pressure(count);
  for (int i = 0; i < count; ++i) {
    const bool is_empty = is_partly_empty(i);
    by_empty[i] = is_empty ? 0 : 1;
    by_pressure[i] = is_empty ? bound_scale_ : 0;
    residual[i] = is_empty ? bound_scale_ * (pressure_.now()[i] - *options_.cavitation) : empty_->now()[i];
  }
  assembly.add(*empty_, residual);
  assembly.compare_with(*empty_, aperture_.now().lpNorm<Eigen::Infinity>());
  assembly.diagonal(*empty_, *empty_, by_empty);
  assembly.diagonal(*empty_, pressure_, by_pressure);
}

/// Cells in the place of a replaced one share its opening unevenly, so an even share of what is empty could be more
/// than they hold. Each gets the same part of its opening; the volume stays.
void FractureFlow::settled(const MeshChange& change) {
  if (history_) history_->hold(false);
  if (!empty_ || change.replaced_parts.empty()) return;
  // Cells that have replaced the same ones.
  std::map<int, int> group_of_old, group_of_new;
  for (const ReplacedPart& part : change.replaced_parts) {
    const int group = group_of_old.emplace(part.old_cell, part.old_cell).first->second;
    const auto [found, is_first] = group_of_new.emplace(part.cell, group);
    if (is_first || found->second == group) continue;
    const int joined = found->second;
    for (auto* groups : {&group_of_old, &group_of_new})
      for (auto& [cell, other] : *groups)
        if (other == joined) other = group;
  }
  std::map<int, std::pair<double, double>> volumes;  // m^2: empty, and all
  for (const auto& [cell, group] : group_of_new) {
    const double length = mesh_.fracture_cells[cell].measure;
    volumes[group].first += length * empty_->accepted()[cell];
    volumes[group].second += length * aperture_.accepted()[cell];
  }
  Vector empty = empty_->accepted();
  for (const auto& [cell, group] : group_of_new)
    if (const auto& [without_fluid, all] = volumes[group]; all > 0)
      empty[cell] = aperture_.accepted()[cell] * (without_fluid / all);
  empty_->set_both(std::move(empty));
}

double FractureFlow::filled_part(int cell) const {
  const double aperture = aperture_.now()[cell];
  if (!empty_ || !(aperture > 0)) return 1;
  return std::clamp(1 - empty_->now()[cell] / aperture, 0.0, 1.0);
}

std::uint64_t FractureFlow::discrete_state() const {
  std::uint64_t hash = 0;
  if (empty_)
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i) hash = hash * 1000003 + is_partly_empty(i);
  const bool is_weighed = std::ranges::any_of(links_, &Link::only_out);
  if (is_weighed && density_) find_excess();
  for (const Link& link : links_)
    if (link.only_out) hash = hash * 1000003 + (is_shut(link) ? 2 : 1);
  return hash;
}

void FractureFlow::begin_step(const StepTime& step) {
  if (history_) history_->begin_step({step.start, step.dt, step.end}, state_remembered());
  share_points();
  if (density_) weigh_links();
  if (!empty_) return;
  // An aperture over a pressure, as they are at the start of the step.
  const double above = (pressure_.accepted().array() - *options_.cavitation).maxCoeff();
  bound_scale_ =
      aperture_.accepted().lpNorm<Eigen::Infinity>() / std::max({above, std::abs(*options_.cavitation), 1.0});
}

}  // namespace sprekk::fracture_flow
