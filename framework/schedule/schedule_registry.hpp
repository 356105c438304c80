// Further kinds of schedule steps: each registers itself with one line at the end of its source, also in a plug-in:
//
//   const RegisterScheduleStep registration({"repeat", read_repeat, [] { return RepeatOptions().spec(); }});
#pragma once

#include "framework/schedule/schedule_context.hpp"

namespace sprekk {

/// Adds a kind of step when it is constructed, with its key in the scene. A key that exists is refused as a type that
/// exists is (refuse_registration).
struct RegisterScheduleStep {
  explicit RegisterScheduleStep(const ScheduleKind& kind);
};

}  // namespace sprekk
