// The stress of rock that has not moved.
#pragma once

#include "components/poromechanics/options.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// The initial stress plus what pore pressures add to it, of each cell, Pa, (xx, yy, xy): the stress where the
/// displacement is zero, also before anything has been discretized, when sides and walls have no load yet.
/// `pore_stress`: what is added to xx and yy, Pa.
Vector stress_without_displacement(const Mesh& mesh, const Options& options, const Vector& pore_stress);

}  // namespace sprekk::poromechanics
