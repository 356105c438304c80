// How well a run conserves fluid and heat.
#pragma once

#include <string>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {

/// |stored + outflow − injected| over all that was moved, of a quantity with a balance ("fluid", "heat"). NaN where
/// nothing was.
double balance_error(SceneRun& run, const std::string& quantity = "fluid");

}  // namespace sprekk::testing
