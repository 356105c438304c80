// Finds pressures, or temperatures, that violate a discrete maximum principle.
#pragma once

#include <vector>

#include "components/capabilities/flux_discretization.hpp"

namespace sprekk {

/// The state of the flow at the end of a step. A potential is a pressure minus that of a fluid column at rest. Units
/// are those of a fluid in a plane. For conducted heat, potentials are temperatures in K, fluxes are in W/m, and
/// capacities are in J/(m K).
struct FlowStep {
  const Mesh& mesh;
  const std::vector<FlowCondition>& conditions;
  Vector potential;                                  ///< at its end, one a cell, Pa
  Vector potential_before;                           ///< Pa
  const Vector &boundary_values, &boundary_changes;  ///< see FluxOperators, Pa
  const Vector& fluxes;                              ///< at its end, one a face, m^2/s
  const Vector& capacity;                            ///< one a cell, m^2/Pa
  double dt;                                         ///< s
  double base;  ///< Pa, the largest of the numbers whose differences potentials are: their round-off is relative to it
};

/// How many cells overshoot, and by how much.
struct Overshoots {
  long cells = 0;
  double largest = 0;  ///< Pa
  double range = 0;    ///< of all potentials, with prescribed ones, Pa
  int cell = none;     ///< where it is largest
};

/// Finds cells that overshoot. A cell overshoots if its potential is higher than before, than in all cells around it
/// and than on its sides, although fluid enters it only from these: fluid that enters and is not stored must find a way
/// down the potential. Undershoots are defined in the same way. Amounts that other parts add to the balance are found
/// from what the cell stores and passes on. Overshoots below 1 % of the range of potentials do not count: the errors of
/// a coarse mesh may be that large. Nothing counts where all potentials are equal except for what solvers leave. Counts
/// the cells of all processes. Collective.
Overshoots find_overshoots(const FlowStep& step);

}  // namespace sprekk
