#include "framework/run/early_end.hpp"

#include "framework/output/progress.hpp"

namespace sprekk {

void EarlyEnd::check(const Model& model, const StepTime& step, const std::vector<Quantity>& quantities) {
  if (is_steady(model, step)) steady_since_ = step.start;
  has_stopped_ = stop_.is_reached(quantities);
  if (has_stopped_) stop_text_ = stop_.text(quantities);
}

std::string EarlyEnd::text() const {
  if (has_stopped_) return stop_text_;
  return steady_since_ ? "steady since " + duration_text(*steady_since_) : "";
}

}  // namespace sprekk
