// Steps that are run one after the other.
#pragma once

#include "framework/schedule/schedule_step.hpp"

namespace sprekk {

/// Runs its steps one after the other, and stops at the first that does not converge.
class SequenceStep : public ScheduleStep {
 public:
  explicit SequenceStep(std::vector<std::unique_ptr<ScheduleStep>> steps) : steps_(std::move(steps)) {}
  StepStatus run(const StepTime& step) override;
  StepStatus run_until(const StepTime& step, const std::function<bool()>& is_enough) override;
  std::vector<const Field*> unknowns() const override;
  int systems_in_turn(const StepTime& step) const override;
  bool solves(const Field& field, const StepTime& step) const override;
  std::vector<const Field*> solved_first(const StepTime& step) const override;
  void iterate_with(const std::vector<const Field*>& unknowns) override {
    for (auto& inner : steps_) inner->iterate_with(unknowns);
  }
  std::string describe() const override { return "sequence"; }
  std::vector<const ScheduleStep*> children() const override;
  void add_counts(LinearCounts& counts) const override;
  const std::vector<std::unique_ptr<ScheduleStep>>& steps() const { return steps_; }
  /// Gives its steps away; it has none then.
  std::vector<std::unique_ptr<ScheduleStep>> take_steps() { return std::move(steps_); }

 private:
  std::vector<std::unique_ptr<ScheduleStep>> steps_;
};

}  // namespace sprekk
