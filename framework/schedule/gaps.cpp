#include "framework/schedule/gaps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/config/units.hpp"

namespace sprekk {

std::vector<StepTime> sampled_steps(const TimeOptions& time, int most) {
  const double duration = time.end - time.start;
  const int count = static_cast<int>(std::clamp(std::ceil(duration / time.step), 1.0, double(most)));
  std::vector<StepTime> steps;
  for (int i = 0; i < count; ++i) {
    const double start = time.start + duration * i / count, end = time.start + duration * (i + 1) / count;
    steps.push_back({start, end - start, end});
  }
  return steps;
}

void note_gaps(const ScheduleStep& schedule, const FieldStore& fields, const TimeOptions& time, Notes& notes) {
  const std::vector<StepTime> steps = sampled_steps(time);
  for (const auto& field : fields.all()) {
    if (!field->is_solved() || field->size() == 0) continue;
    std::optional<StepTime> gap;  // the first one, as a whole
    for (const StepTime& step : steps) {
      const bool is_solved = schedule.solves(*field, step);
      if (gap && (is_solved || step.start > gap->end)) break;
      if (is_solved) continue;
      gap = gap ? StepTime{gap->start, step.end - gap->start, step.end} : step;
    }
    if (!gap) continue;
    notes.add("no solve for " + field->spec().owner,
              "no step solves for '" + field->spec().owner + "' from about " + quantity_text(gap->start, "s") + " to " +
                  quantity_text(gap->end, "s") +
                  " (no 'when' holds there: its values stay, and what happens is not "
                  "computed) close the gap, unless it is meant");
  }
}

}  // namespace sprekk
