// The state that a run begins with: initial values, those of another run, or one that is settled.
#pragma once

#include "framework/scene/model.hpp"

namespace sprekk {

/// Puts a model that has just been built into the state of its scene's `start:`, and accepts it. Does nothing without
/// that section. Throws InputError for a run whose state does not fit this model, and std::runtime_error where no
/// equilibrium is found.
void take_start(Model& model);

}  // namespace sprekk
