#include "components/fracture_flow/laws/formula_law.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk::fracture_flow {

const StateVariables& conduction_variables() {
  static const StateVariables variables = {
      {"a", "m", "aperture"},
      {"p", "Pa", "pressure of the fluid"},
      {"T", "K", "temperature of the fluid"},
      {"sigma_n", "Pa", "effective normal stress on the walls, positive where they press"}};
  return variables;
}

HydraulicState hydraulic_state(const StateFormula& formula, int cell, double lowest, ConductionState state) {
  const bool is_lowest = state[0] < lowest;
  state[0] = std::max(state[0], lowest);
  HydraulicState result{};
  const double transmissivity = formula.at(cell, state, result.by);
  SPREKK_EXPECT(transmissivity >= 0, transmissivity);
  result.value = std::cbrt(12 * transmissivity);
  if (result.value < lowest) return {lowest, {}};
  for (double& by : result.by) by *= 4 / (result.value * result.value);
  if (is_lowest) result.by[0] = 0;
  return result;
}

}  // namespace sprekk::fracture_flow
