// The multi-point stress approximation with weakly held rotations, in a plane and in space, with the
// Biot terms and the pressure stabilization that come from the same local problems.
#pragma once

#include <vector>

#include "components/poromechanics/mpsa/limits.hpp"
#include "components/poromechanics/stiffness.hpp"
#include "components/poromechanics/stress_operators.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// Discretizes the stress by MPSA-W, with the Biot terms and the stabilization of Nordbotten 2016. `conditions`:
/// [f][direction]. `nodes` as for MPFA. Exact on any mesh for linear displacements with constant s, and for two layers
/// in any direction that each have a linear displacement, stress s and stiffness of their own (see LocalStresses).
/// Throws std::invalid_argument for arguments that do not fit the mesh and std::runtime_error for a stiffness that is
/// not positive definite.
StressOperators discretize_mpsa(const Mesh& mesh, const std::vector<Stiffness>& stiffness,
                                const std::vector<FaceConditions>& conditions, const std::vector<char>& nodes = {},
                                const MpsaLimits& limits = {});

}  // namespace sprekk::poromechanics
