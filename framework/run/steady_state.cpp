#include "framework/run/steady_state.hpp"

#include <algorithm>

#include "framework/schedule/relative_change.hpp"

namespace sprekk {

bool is_steady(const Model& model, const StepTime& step) {
  const TimeOptions& time = model.scene().time;
  if (!time.stop_when_steady) return false;
  for (const double jump : model.switch_times())
    if (jump > step.start && jump < time.end) return false;
  const double rest = std::max(1.0, (time.end - step.end) / step.dt);
  return rest * relative_change(model.schedule().unknowns()) <= *time.stop_when_steady;
}

}  // namespace sprekk
