#include "components/fine_fracture/growth/viscous_state.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

FrontState against_viscosity(FrontState state, double apparent_toughness, double scale) {
  SPREKK_EXPECT(apparent_toughness > 0 && scale > 0, apparent_toughness, scale);
  if (!state.is_evaluated) return state;
  const Sifs& k = state.sifs;
  state.load = equivalent_sif(k) / apparent_toughness;
  // Of a tip that grows K² = K_I² + K_II², as in Front.
  const double release = k.k1 > std::abs(k.k2) ? std::hypot(k.k1, k.k2) : equivalent_sif(k);
  state.excess = ((k.k1 > 0 ? release : k.k1) - apparent_toughness) / scale;
  state.sifs.k1 = std::max(k.k1, apparent_toughness);
  return state;
}

}  // namespace sprekk::fine_fracture
