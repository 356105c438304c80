// Pressures that no flow explains: what is left of a maximum principle.
#pragma once

#include <vector>

#include "components/matrix_flow/flux_operators.hpp"

namespace sprekk::matrix_flow {

/// One step of the flow. Potentials are pressures without those of a column at rest.
struct FlowStep {
  const Mesh& mesh;
  const std::vector<FlowCondition>& conditions;
  Vector potential;                                  ///< at its end, one a cell, Pa
  Vector potential_before;                           ///< Pa
  const Vector &boundary_values, &boundary_changes;  ///< see FluxOperators, Pa
  const Vector& fluxes;                              ///< at its end, one a face, m^2/s
  const Vector& capacity;                            ///< one a cell, m^2/Pa
  double dt;                                         ///< s
};

struct Overshoots {
  long cells = 0;
  double largest = 0;  ///< Pa
  double range = 0;    ///< of all potentials there are, Pa
};

/// A cell overshoots if its potential is higher than before, than those of all cells around and than those on its
/// sides, and yet nothing flows into it but through faces that it shares with these: there must be a way downhill for
/// what comes and does not stay. In the same way for lower. What other parts add to the balance is seen in what the
/// cell stores and passes on. Below 1 % of the range of potentials nothing is said: that much the errors of a coarse
/// mesh may be. Of all processes.
Overshoots find_overshoots(const FlowStep& step);

}  // namespace sprekk::matrix_flow
