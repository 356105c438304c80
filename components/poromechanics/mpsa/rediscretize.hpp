// MPSA on a mesh that has changed in a few places.
#pragma once

#include "components/poromechanics/mpsa/local_stresses.hpp"
#include "components/poromechanics/mpsa/mpsa.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk::poromechanics {

/// The arguments of discretize_mpsa, for all nodes.
struct StressInputs {
  const Mesh& mesh;
  const std::vector<Stiffness>& stiffness;
  const std::vector<FaceConditions>& conditions;
};

/// Operators on the new mesh, and how much was computed.
struct Rediscretized {
  StressOperators operators;
  int regions, cells;  ///< local problems that were solved, and cells that they touch
};

/// The operators that discretize_mpsa gives for `after`, to the bit, from those that it gave for `before`: local
/// problems are solved only around nodes where an input differs (KeptRegions). In one process.
Rediscretized rediscretize_mpsa(const StressInputs& before, const StressOperators& operators, const StressInputs& after,
                                const MeshChange& change);

}  // namespace sprekk::poromechanics
