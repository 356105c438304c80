// The law of walls that slide, as a fine level has it for the places within a cell.
#include <algorithm>
#include <cmath>

#include "components/contact/frictional_contact.hpp"
#include "components/contact/trial_state.hpp"
#include "framework/round_off.hpp"

namespace sprekk::contact {

/// The largest pressure between walls near a cell on its fracture, Pa.
double FrictionalContact::pressure_beside(int i) const {
  constexpr int near = 3;  // cells: those in which walls hardly touch may be neighbours
  const Fracture& fracture = mesh_.fractures[mesh_.fracture_cells[i].fracture];
  const int last = fracture.first_cell + fracture.cell_count - 1;
  double largest = 0;
  for (int k = std::max(fracture.first_cell, i - near); k <= std::min(last, i + near); ++k)
    largest = std::max(largest, -traction_.now()[dimension * k]);
  return largest;
}

std::optional<SlidingWalls> FrictionalContact::sliding(int i) const {
  if constexpr (dimension != 2) return std::nullopt;
  if (is_bonded(i) || !is_on_fracture_cell(i)) return std::nullopt;
  constexpr double least_slip = 1e-3;  // of the slip that would take all shear from the walls
  const Trial t = trial(i);
  const double normal = traction_.now()[dimension * i], shear = traction_.now()[dimension * i + 1],
               slip = jump_.now()[dimension * i + 1], stiffness_to_slip = stiffness()[dimension * i + 1];
  const bool is_closed = normal < 0 && !t.is_open();
  const double held = t.strength.cohesion - t.strength.friction * normal;
  // Walls at rest that have slid keep their slip and opening within the cell: friction is then the mobilised one.
  // Otherwise a tiny fall of the pressure would move the walls next to a kink at once.
  const bool has_slid = std::abs(slip) > least_slip * std::abs(shear) / stiffness_to_slip;
  if (is_closed && !has_slid && std::abs(shear) < (1 - rounding::far_above) * held) return std::nullopt;
  const double dilation = std::copysign(t.dilation, slip),
               opening = dilated(i, std::abs(slip)) - dilation * slip - closure(i, normal);
  if (!is_closed) return SlidingWalls{t.strength.friction, std::copysign(1.0, slip), dilation, opening};
  // Walls hardly touch in a cell that has parted over most of its length. Where they do they press like those beside
  // it, and the rock that brings them to rest takes about as much shear from them as from all other places. The ratio
  // of the two small means could have either sign. As the cell parts, this becomes the law of open walls.
  constexpr double hardly = 0.2;  // of the pressure beside
  const double side = slip != 0 ? std::copysign(1.0, slip) : std::copysign(1.0, shear), taken = held - side * shear;
  // (Cohesion over a pressure that vanishes has no limit.)
  const double least = t.strength.cohesion > 0
                           ? 0
                           : std::max(hardly * pressure_beside(i), least_slip * std::abs(slip) * stiffness_to_slip);
  const double along = -held / normal - taken / std::max(-normal, least);
  return SlidingWalls{std::abs(along), side * std::copysign(1.0, along), dilation, opening};
}

}  // namespace sprekk::contact
