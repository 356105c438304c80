// Times at which a schedule leaves fields out.
#pragma once

#include "framework/assembly/notes.hpp"
#include "framework/field/field_store.hpp"
#include "framework/schedule/schedule_step.hpp"
#include "framework/schedule/step_controller.hpp"

namespace sprekk {

/// Equally long steps that cover a run: as many as the run has by its standard step, but at most `most`.
std::vector<StepTime> sampled_steps(const TimeOptions& time, int most = 1000);

/// Notes fields that the schedule solves for in some steps and leaves out in others, where no `when` holds.
void note_gaps(const ScheduleStep& schedule, const FieldStore& fields, const TimeOptions& time, Notes& notes);

}  // namespace sprekk
