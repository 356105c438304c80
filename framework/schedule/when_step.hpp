// when: the steps inside are run only while a condition holds.
#pragma once

#include "framework/config/data.hpp"
#include "framework/config/spec.hpp"
#include "framework/schedule/schedule_context.hpp"

namespace sprekk {

/// Parameters of a `when` step.
struct WhenOptions {
  Data condition;
  Spec spec();
};

/// Runs the step inside if the condition, at the middle of the time step, is not 0; otherwise the fields that it solves
/// for keep their values.
class WhenStep : public ScheduleStep {
 public:
  WhenStep(const WhenOptions& options, std::unique_ptr<ScheduleStep> inside)
      : options_(options), inside_(std::move(inside)) {}
  StepStatus run(const StepTime& step) override;
  std::vector<const Field*> unknowns() const override { return inside_->unknowns(); }
  int systems_in_turn(const StepTime& step) const override { return holds(step) ? inside_->systems_in_turn(step) : 0; }
  bool solves(const Field& field, const StepTime& step) const override {
    return holds(step) && inside_->solves(field, step);
  }
  std::vector<const Field*> solved_first(const StepTime& step) const override {
    return holds(step) ? inside_->solved_first(step) : std::vector<const Field*>();
  }
  void note_step(Notes& notes, const StepTime& step) const override {
    if (holds(step)) inside_->note_step(notes, step);
  }
  void require_held(const StepTime& step) const override {
    if (holds(step)) inside_->require_held(step);
  }
  std::string describe() const override { return "when"; }
  std::vector<const ScheduleStep*> children() const override { return {inside_.get()}; }
  void add_counts(LinearCounts& counts) const override { inside_->add_counts(counts); }

 private:
  bool holds(const StepTime& step) const;

  WhenOptions options_;
  std::unique_ptr<ScheduleStep> inside_;
};

}  // namespace sprekk
