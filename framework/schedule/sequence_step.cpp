#include "framework/schedule/sequence_step.hpp"

#include <algorithm>

namespace sprekk {

StepStatus SequenceStep::run(const StepTime& step) {
  return run_until(step, [] { return false; });
}

StepStatus SequenceStep::run_until(const StepTime& step, const std::function<bool()>& is_enough) {
  StepStatus status{true, "", 0};
  for (auto& inner : steps_) {
    const StepStatus inner_status = inner->run(step);
    status.iterations = std::max(status.iterations, inner_status.iterations);
    status.of_newton = std::max(status.of_newton, inner_status.effort());
    if (!inner_status.converged) {
      StepStatus failed = inner_status;
      failed.reason = inner->describe() + ": " + inner_status.reason;
      failed.iterations = status.iterations;
      return failed;
    }
    if (is_enough()) break;
  }
  return status;
}

std::vector<const Field*> SequenceStep::unknowns() const {
  std::vector<const Field*> all;
  for (const auto& inner : steps_)
    for (const Field* field : inner->unknowns())
      if (std::find(all.begin(), all.end(), field) == all.end()) all.push_back(field);
  return all;
}

int SequenceStep::systems_in_turn(const StepTime& step) const {
  int systems = 0;
  for (const auto& inner : steps_) systems += inner->systems_in_turn(step);
  return systems;
}

bool SequenceStep::solves(const Field& field, const StepTime& step) const {
  return std::ranges::any_of(steps_, [&](const auto& inner) { return inner->solves(field, step); });
}

std::vector<const Field*> SequenceStep::solved_first(const StepTime& step) const {
  for (const auto& inner : steps_)
    if (inner->systems_in_turn(step) > 0) return inner->solved_first(step);
  return {};
}

std::vector<const ScheduleStep*> SequenceStep::children() const {
  std::vector<const ScheduleStep*> children;
  for (const auto& inner : steps_) children.push_back(inner.get());
  return children;
}

void SequenceStep::add_counts(LinearCounts& counts) const {
  for (const auto& inner : steps_) inner->add_counts(counts);
}

}  // namespace sprekk
