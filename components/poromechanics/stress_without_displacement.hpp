// The stress of rock that has not moved.
#pragma once

#include "components/poromechanics/options.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// The total stress of each cell where the displacement is zero: the initial stress plus that of the pore pressures,
/// Pa. It is known before anything has been discretized, when sides and walls have no load yet.
/// `pore_stress`: what pore pressures add to its diagonal, Pa.
Vector stress_without_displacement(const Mesh& mesh, const Options& options, const Vector& pore_stress);

}  // namespace sprekk::poromechanics
