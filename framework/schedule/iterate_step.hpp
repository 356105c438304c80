// iterate: repeats the steps inside until the coupled residual of all their equations is small.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/acceleration/registry.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/config/spec.hpp"
#include "framework/schedule/convergence_criteria.hpp"
#include "framework/schedule/fallback_solve.hpp"
#include "framework/schedule/passes/diverging_steps.hpp"
#include "framework/schedule/passes/losses_in_passes.hpp"
#include "framework/schedule/residual_check.hpp"
#include "framework/schedule/schedule_context.hpp"

namespace sprekk {

/// Parameters of an `iterate` step.
struct IterateOptions {
  UntilOptions until;
  std::string order = "gauss_seidel";
  std::string fallback = "monolithic";
  AccelerationOptions acceleration;
  NewtonOptions newton;  ///< of the fallback
  LinearOptions linear;
  bool has_substeps = false;  ///< whether steps inside take substeps
  Spec spec();
};

/// Repeats the steps inside, with acceleration if asked for. Unless the scene says otherwise, the iteration has
/// converged when the residual of all equations inside, without stabilization, is small against their own terms; small
/// updates do not suffice. If steps inside take substeps, the equations of the whole step do not hold, and the
/// estimated error of all fields replaces the residual: the change by a pass, times ρ/(1 − ρ), with ρ the ratio of this
/// change to that by the pass before; changes by round-off are ignored. Passes end early where their changes only grow.
///
/// If passes do not converge, the step is solved for all unknowns at once, unless the scene says otherwise
/// (FallbackSolve); if that does not converge either, the step is refused. An iteration over substeps has no such
/// system.
class IterateStep : public ScheduleStep, public KeepsState {
 public:
  /// `pass`: receives the number of the pass, for those who log what happens in it. Throws InputError for a field to
  /// accelerate that is not solved inside.
  IterateStep(const IterateOptions& options, std::unique_ptr<ScheduleStep> inside, const ScheduleContext& context,
              std::shared_ptr<int> pass);
  StepStatus run(const StepTime& step) override;
  std::vector<const Field*> unknowns() const override { return inside_->unknowns(); }
  int systems_in_turn(const StepTime& step) const override { return std::min(1, inside_->systems_in_turn(step)); }
  std::string describe() const override { return "iterate"; }
  std::vector<const ScheduleStep*> children() const override { return {inside_.get()}; }
  double largest_imbalance() const override;
  void add_counts(LinearCounts& counts) const override;
  void note_step(Notes& notes, const StepTime& step) const override;
  void accepted() override;
  void rewound() override;
  void save(std::map<std::string, Vector>& state) const override;
  void restore(const std::map<std::string, Vector>& state) override;

 private:
  class Passes;  // iterate_passes.cpp
  StepStatus make_passes(const StepTime& step);
  /// Counts exchanged amounts anew with the final values of all fields: each solve has counted them with the values
  /// that the other fields had at its turn. What remains of a balance after the last pass is carried into the next
  /// step (CountsLater).
  StepStatus converged(const StepTime& step, const StepStatus& status);
  ResidualCheck coupled_residual(const StepTime& step) const;
  void choose_scales();
  /// If steps inside take substeps: estimates the change of values by round-off alone, from the equations of the whole
  /// step.
  void find_round_off(const StepTime& step);
  /// The largest change of a field beyond round-off; `change`: of its values.
  double largest_change(std::size_t field, const Vector& change) const;
  void begin_acceleration();
  /// Sets the accelerated fields to the next iterate; `before`: their values before the pass.
  void accelerate(const Vector& before);
  Vector accelerated_values() const;
  /// The largest change of each field by a pass over the largest value of any field of its unit.
  ResidualCheck check_changes(const std::vector<Vector>& before) const;
  /// The largest change of any field over the largest value of a field of its unit, before or after; both are scaled.
  double relative_change(const Vector& change, const Vector& before) const;
  /// The status of passes that do not converge. `what`: what they do instead; `factor`: by which changes grow from pass
  /// to pass.
  StepStatus without_end(const StepTime& step, const std::string& what, double factor, int pass);
  /// Advice for passes that diverge: options that the scene does not use yet.
  std::string remedies() const;
  std::string most_changed(const Vector& change) const;  ///< the field whose part of a scaled change is largest
  Vector scaled_values() const;
  void set_scaled_values(const Vector& values);

  IterateOptions options_;
  std::unique_ptr<ScheduleStep> inside_;
  std::vector<Part*> parts_;
  std::vector<Field*> fields_;
  ConvergenceCriteria criteria_;
  BlockSystem system_;
  IterationLog log_;
  std::vector<double> scales_;                ///< one for each field, from the first pass
  std::vector<Vector> round_off_;             ///< of each field's values; empty where residuals are looked at
  std::unique_ptr<Accelerator> accelerator_;  ///< nullptr for none
  std::vector<std::size_t> accelerated_;      ///< which of the fields
  Vector acceleration_scale_;                 ///< one for each of their values
  std::shared_ptr<int> pass_;                 ///< the number of the pass, for the log
  std::string history_;                       ///< what its values in a checkpoint begin with
  std::optional<FallbackSolve> fallback_;
  DivergingSteps diverging_;
  LossesInPasses losses_;
};

}  // namespace sprekk
