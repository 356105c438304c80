// Whether anything is still going on in a run.
#pragma once

#include "framework/scene/model.hpp"

namespace sprekk {

/// `stop_when_steady:` of `time:`: whether changes like those of `step`, which is about to be accepted, would add up to
/// less than that share of the unknowns until the end, with no data that jump ahead. Never in a scene that has none.
bool is_steady(const Model& model, const StepTime& step);

}  // namespace sprekk
