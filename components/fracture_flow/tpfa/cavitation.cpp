// Fractures in which fluid cannot follow: the pressure has a lower bound p_c, and a part e of the aperture is empty,
//   p >= p_c,  e >= 0,  (p − p_c) e = 0
// in each cell: the condition of Elrod and Adams (1974) in the form of a complementarity (Giacopini et al., J.
// Tribology 132, 2010, 041702), and that of the lag at the tip of a hydraulic fracture (Peirce and Detournay, Comput.
// Methods Appl. Mech. Engrg. 197 (2008) 2858). A cell stores L (a − e): the balance of fluid is that of full cells.
// Between cells at the bound nothing flows, as their pressures are equal, and what flows into one fills it.
#include <fmt/format.h>

#include <algorithm>

#include "components/fracture_flow/tpfa/fracture_flow.hpp"

namespace sprekk::fracture_flow {

void FractureFlow::check_bound(double pressure, const Origin& where, const std::string& what) const {
  if (!options_.cavitation || pressure >= *options_.cavitation) return;
  throw InputError(where, fmt::format("{} is below the bound of '{}'", what, name()),
                   fmt::format("it is {:.6g} Pa, and 'cavitation' keeps pressures at {:.6g} Pa or more", pressure,
                               *options_.cavitation),
                   "lower 'cavitation', or raise the pressure");
}

/// Whether the condition of the cell is p = p_c; else it is e = 0. Their solution does not depend on the scale, which
/// compares both away from it.
bool FractureFlow::is_partly_empty(int cell) const {
  return empty_ && empty_->now()[cell] > bound_scale_ * (pressure_.now()[cell] - *options_.cavitation);
}

void FractureFlow::bound_pressure(Assembly& assembly) const {
  const int count = mesh_.fracture_cell_count();
  Vector length(count);
  for (int i = 0; i < count; ++i) length[i] = mesh_.fracture_cells[i].measure;
  assembly.diagonal(pressure_, *empty_, -length);
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

std::uint64_t FractureFlow::discrete_state() const {
  std::uint64_t hash = 0;
  if (empty_)
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i) hash = hash * 1000003 + is_partly_empty(i);
  return hash;
}

void FractureFlow::begin_step(const StepTime&) {
  if (!empty_) return;
  // An aperture over a pressure, as they are at the start of the step.
  const double above = (pressure_.accepted().array() - *options_.cavitation).maxCoeff();
  bound_scale_ =
      aperture_.accepted().lpNorm<Eigen::Infinity>() / std::max({above, std::abs(*options_.cavitation), 1.0});
}

}  // namespace sprekk::fracture_flow
