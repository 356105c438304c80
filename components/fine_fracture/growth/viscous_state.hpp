// The state of a tip in a trial whose fluid holds it back, for the search for a front.
#pragma once

#include "components/fine_fracture/growth/front.hpp"

namespace sprekk::fine_fracture {

/// The state against an apparent toughness (Pa sqrt(m)), ViscousTip::apparent_toughness times K_IC. A trial that
/// advances too far draws its fluid thin, and the walls are pulled together: K_I is then far below zero and falls in
/// proportion to the advance, while the apparent toughness changes from trial to trial with the speed. So the excess is
/// their difference (K_I for K_eq where that is negative) over a `scale` (Pa sqrt(m)) that is the same in all trials of
/// a step, and K_II is compared with no less than the apparent toughness.
FrontState against_viscosity(FrontState state, double apparent_toughness, double scale);

}  // namespace sprekk::fine_fracture
