// The law of walls that slide, as a fine level has it for the places within a cell.
#include <algorithm>
#include <cmath>

#include "components/contact/frictional_contact.hpp"
#include "components/contact/trial_state.hpp"

namespace sprekk::contact {

/// By how much the pressure between the walls of a cell is below that of the cells beside it, Pa. The fracture parts
/// over a part of such a cell; where its walls still touch, they press like those beside it.
double FrictionalContact::missing_pressure(int i) const {
  const Fracture& fracture = mesh_.fractures[mesh_.fracture_cells[i].fracture];
  const int last = fracture.first_cell + fracture.cell_count - 1;
  double least = traction_.now()[dimension * i];
  const double here = least;
  for (int k = std::max(fracture.first_cell, i - 1); k <= std::min(last, i + 1); ++k)
    least = std::min(least, traction_.now()[dimension * k]);
  return here - least;
}

std::optional<SlidingWalls> FrictionalContact::sliding(int i) const {
  if constexpr (dimension != 2) return std::nullopt;
  if (is_bonded(i) || !is_on_fracture_cell(i)) return std::nullopt;
  constexpr double at_bound = 1e-6;    // relative: walls with less shear than the bound by more than this stick
  constexpr double least_slip = 1e-3;  // of the slip that would take all shear from the walls
  const Trial t = trial(i);
  const double normal = traction_.now()[dimension * i], shear = traction_.now()[dimension * i + 1],
               slip = jump_.now()[dimension * i + 1], stiffness_to_slip = stiffness()[dimension * i + 1];
  const bool is_closed = normal < 0 && !t.is_open();
  const double held = t.strength.cohesion - t.strength.friction * normal;
  // Walls at rest that have slid keep their slip and opening within the cell: the friction is then the mobilised one.
  // Otherwise a tiny fall of the pressure would change the walls next to a kink at once.
  const bool has_slid = std::abs(slip) > least_slip * std::abs(shear) / stiffness_to_slip;
  if (is_closed && !has_slid && std::abs(shear) < (1 - at_bound) * held) return std::nullopt;
  const double dilation = std::copysign(t.dilation, slip),
               opening = dilated(i, std::abs(slip)) - dilation * slip - closure(normal);
  if (!is_closed) return SlidingWalls{t.strength.friction, std::copysign(1.0, slip), dilation, opening};
  // The rock that brings walls to rest takes about as much shear from all places. So where a part of the cell has
  // parted, the mobilised friction is that of the pressure at the places that touch. As the cell parts, this becomes
  // the law of open walls; the ratio of the two small means could have either sign.
  const double more = std::max(missing_pressure(i), least_slip * std::abs(slip) * stiffness_to_slip);
  const double along = shear + std::copysign(t.strength.friction * more, slip);
  return SlidingWalls{std::abs(along) / (more - normal), std::copysign(1.0, along), dilation, opening};
}

}  // namespace sprekk::contact
