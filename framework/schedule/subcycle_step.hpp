// subcycle: the steps inside take several smaller time steps while all other fields wait.
#pragma once

#include "framework/config/spec.hpp"
#include "framework/schedule/schedule_context.hpp"

namespace sprekk {

/// Parameters of a `subcycle` step.
struct SubcycleOptions {
  int count = 2;
  Spec spec();
};

/// Fields that are not solved for inside keep their latest values. After each substep the fields inside, and the
/// cumulative balances kept of them, are accepted, so that a change of something outside counts once, in the first
/// substep. At the end the accepted values of the start are put back: the step as a whole is accepted by the step
/// controller.
class SubcycleStep : public ScheduleStep {
 public:
  SubcycleStep(const SubcycleOptions& options, std::unique_ptr<ScheduleStep> inside, const ScheduleContext& context);
  StepStatus run(const StepTime& step) override;
  std::vector<const Field*> unknowns() const override { return inside_->unknowns(); }
  int systems_in_turn(const StepTime& step) const override { return inside_->systems_in_turn(step); }
  bool solves(const Field& field, const StepTime& step) const override { return inside_->solves(field, step); }
  std::vector<const Field*> solved_first(const StepTime& step) const override { return inside_->solved_first(step); }
  void iterate_with(const std::vector<const Field*>& unknowns) override { inside_->iterate_with(unknowns); }
  std::string describe() const override;
  std::vector<const ScheduleStep*> children() const override { return {inside_.get()}; }
  void add_counts(LinearCounts& counts) const override { inside_->add_counts(counts); }

 private:
  StepStatus take_substeps(const StepTime& step);

  SubcycleOptions options_;
  std::unique_ptr<ScheduleStep> inside_;
  std::vector<Part*> parts_;
  std::vector<Field*> fields_;  ///< solved for inside, and the cumulative balances kept of them
};

}  // namespace sprekk
