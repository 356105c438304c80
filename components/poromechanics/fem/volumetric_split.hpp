// A stiffness divided into a part that resists a change of volume alone, and the rest.
#pragma once

#include <vector>

#include "components/poromechanics/stiffness.hpp"
#include "framework/types.hpp"

namespace sprekk::poromechanics {

/// C = kept + taken · m m^T, with m of isotropic_components: `kept` resists a change of area, or of volume, by at most
/// `kept_of_shear` times the shear stiffness (isotropic: lambda + 2 G over the dimension, so up to nu = 1/4 nothing is
/// taken). Where displacements are linear in triangles, the part that is taken has to be a stress of its own: otherwise
/// cells could not keep their volume and bend at the same time (locking).
struct VolumetricSplit {
  std::vector<Stiffness> kept;  ///< Pa, positive definite
  Vector taken;                 ///< Pa, of each cell, 0 or more
};
VolumetricSplit split_volumetric(const std::vector<Stiffness>& stiffness);

}  // namespace sprekk::poromechanics
