// The state at the end of another run as the start of this one.
#pragma once

#include <string>

#include "framework/scene/model.hpp"

namespace sprekk {

/// Gives the fields of `model` the values that those of the same names have in the checkpoint of another run, to the
/// bit, and sets totals to zero (KeepsTotals). `from`: the folder of its results, or the checkpoint. A component that
/// the other run does not have keeps its initial values, and a note says so. Throws InputError, with the reason, for a
/// folder without a run, another mesh, a component of another type, initial values that differ (changes are counted
/// from them), fields that are missing or have other sizes, and a coupler that would count changes before the start.
void take_state_of_run(const std::string& from, Model& model);

}  // namespace sprekk
