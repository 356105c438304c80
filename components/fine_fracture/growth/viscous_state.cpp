#include "components/fine_fracture/growth/viscous_state.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

FrontState against_viscosity(FrontState state, double apparent_toughness) {
  SPREKK_EXPECT(apparent_toughness > 0, apparent_toughness);
  if (!state.is_evaluated) return state;
  const double opening = state.sifs.k1 > 0 ? equivalent_sif(state.sifs) : state.sifs.k1;
  state.load = opening / apparent_toughness;
  if (state.load >= 1) return state;
  state.load = std::exp(state.load - 1);
  state.sifs.k1 = std::max(state.sifs.k1, apparent_toughness);
  return state;
}

}  // namespace sprekk::fine_fracture
