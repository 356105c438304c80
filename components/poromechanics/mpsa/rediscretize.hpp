// MPSA on a mesh that has changed in a few places.
#pragma once

#include "components/poromechanics/stress_discretization.hpp"

namespace sprekk::poromechanics {

/// The operators that discretize_mpsa gives for `after`, to the bit, from those that it gave for `before`: local
/// problems are solved only around nodes where an input differs (KeptRegions). In one process.
Rediscretized rediscretize_mpsa(const StressInputs& before, const StressOperators& operators, const StressInputs& after,
                                const MeshChange& change);

}  // namespace sprekk::poromechanics
