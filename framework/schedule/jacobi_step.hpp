// Steps that all begin from the same values.
#pragma once

#include "framework/field/field_store.hpp"
#include "framework/schedule/sequence_step.hpp"

namespace sprekk {

/// Runs its steps one after the other, each from the initial values and without the results of the others (block
/// Jacobi). At the end all fields get the results of their steps.
class JacobiStep : public SequenceStep {
 public:
  JacobiStep(std::vector<std::unique_ptr<ScheduleStep>> steps, FieldStore& fields)
      : SequenceStep(std::move(steps)), fields_(fields) {}
  StepStatus run(const StepTime& step) override;
  StepStatus run_until(const StepTime& step, const std::function<bool()>&) override { return run(step); }
  std::string describe() const override { return "all at once"; }

 private:
  FieldStore& fields_;
};

}  // namespace sprekk
