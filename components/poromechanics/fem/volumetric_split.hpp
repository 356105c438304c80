// The part of a stiffness that resists a change of volume alone.
#pragma once

#include <vector>

#include "components/poromechanics/stiffness.hpp"
#include "framework/types.hpp"

namespace sprekk::poromechanics {

/// C = kept + taken · m m^T, with m = (1, 1, 0): `kept` resists a change of area by at most `kept_of_shear` times the
/// shear stiffness (isotropic: lambda + G in the plane, so up to nu = 1/4 nothing is taken). With displacements that
/// are linear in triangles, what is taken has to be a stress of its own: cells can hardly keep their volume and bend.
struct VolumetricSplit {
  std::vector<Stiffness> kept;  ///< Pa, positive definite
  Vector taken;                 ///< Pa, of each cell, 0 or more
};
VolumetricSplit split_volumetric(const std::vector<Stiffness>& stiffness);

}  // namespace sprekk::poromechanics
