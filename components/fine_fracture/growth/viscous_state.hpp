// The state of a tip in a trial whose fluid holds it back, for the search for a front.
#pragma once

#include "components/fine_fracture/growth/front.hpp"

namespace sprekk::fine_fracture {

/// The state against an apparent toughness (Pa sqrt(m)), ViscousTip::apparent_toughness times K_IC. A trial that
/// advances too far draws its fluid thin, and the walls are pulled together: K_I is then far below zero and falls in
/// proportion to the advance. So below the toughness the load is such that its logarithm is K_eq over the apparent
/// toughness less 1 (K_I for K_eq where that is negative), and K_II is compared with the apparent toughness. Where K_eq
/// is the apparent toughness, the load is 1 in either way, and with the same slope.
FrontState against_viscosity(FrontState state, double apparent_toughness);

}  // namespace sprekk::fine_fracture
