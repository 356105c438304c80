// Times at which a schedule leaves fields out.
#pragma once

#include "framework/assembly/notes.hpp"
#include "framework/field/field_store.hpp"
#include "framework/schedule/schedule_step.hpp"
#include "framework/schedule/step_controller.hpp"

namespace sprekk {

/// About the steps of a run: `most` of them, equally long, where there are more.
std::vector<StepTime> sampled_steps(const TimeOptions& time, int most = 1000);

/// Notes fields that the schedule solves for in some steps and leaves out in others, where no `when` holds.
void note_gaps(const ScheduleStep& schedule, const FieldStore& fields, const TimeOptions& time, Notes& notes);

}  // namespace sprekk
