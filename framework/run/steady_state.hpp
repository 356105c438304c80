// Whether a run has reached a steady state.
#pragma once

#include "framework/scene/model.hpp"

namespace sprekk {

/// The condition `stop_when_steady:` of `time:`. True if changes like those of `step`, which is about to be accepted,
/// would add up to less than the given share of the unknowns until the end, and no data jump until then. Never true in
/// a scene without `stop_when_steady:`.
bool is_steady(const Model& model, const StepTime& step);

}  // namespace sprekk
