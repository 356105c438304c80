// The spec of `random:` of a set of fractures.
#pragma once

#include "framework/config/spec.hpp"
#include "framework/meshing/random/random_fractures.hpp"

namespace sprekk {

/// Reads into `set`, whose name and origin the caller knows. `set` must outlive the spec.
Spec random_fractures_spec(RandomFractures& set);

}  // namespace sprekk
