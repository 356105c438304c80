// solve: one simultaneous system for the unknowns of the named components.
#pragma once

#include "framework/config/spec.hpp"
#include "framework/schedule/held_amounts.hpp"
#include "framework/schedule/schedule_context.hpp"
#include "framework/schedule/waiting_response.hpp"

namespace sprekk {

/// Parameters of a `solve` step.
struct SolveOptions {
  std::vector<std::string> components;
  Origin origin;  ///< of the names of components
  std::string stabilization = "none";
  Origin stabilization_origin;
  NewtonOptions newton;  ///< those of the scene, with what the step overrides
  LinearOptions linear;
  bool overrides_newton = false, overrides_linear = false;
  bool may_be_inexact = false;    ///< whether an iteration around the step checks the residuals of its equations
  bool is_over_substeps = false;  ///< whether steps of the iteration around it take substeps
  Spec spec();
};

/// Solves one simultaneous system for the solved fields of its components by Newton's method; all other fields keep
/// their latest values.
class SolveStep : public ScheduleStep {
 public:
  /// Throws InputError for a stabilization that no part of the scene offers, and where a component is missing that the
  /// equations of another need (Part::dependences).
  SolveStep(const SolveOptions& options, const ScheduleContext& context);
  StepStatus run(const StepTime& step) override;
  std::vector<const Field*> unknowns() const override { return {fields_.begin(), fields_.end()}; }
  int systems_in_turn(const StepTime&) const override { return fields_.empty() ? 0 : 1; }
  void iterate_with(const std::vector<const Field*>& unknowns) override {
    iterated_ = unknowns;
    newton_->iterate_at_least_once();
  }
  bool is_stabilized() const override { return options_.stabilization != "none"; }
  /// Throws InputError for a stabilization that has no effect.
  void check() const override;
  void require_held(const StepTime& step) const override;
  double largest_imbalance() const override { return looser_for_balances * options_.newton.residual; }
  void note_step(Notes& notes, const StepTime& step) const override { newton_->note_step(notes, step); }
  std::string describe() const override;
  void add_counts(LinearCounts& counts) const override;

 private:
  /// Throws InputError for a solver that cannot solve for the unknowns.
  void check_solver() const;
  void check_response() const;
  /// The pairs of fields for which the stabilization adds the Schur complement of the waiting unknowns.
  ResponseOptions wanted_responses() const;
  std::vector<const Field*> waiting() const;
  /// The waiting fields that can respond: not those of a component that has no solution while a component of this step
  /// is held (Part::dependences).
  std::vector<const Field*> answering() const;
  const Responses& responses(const StepTime& step);
  /// The waiting fields whose balances keep their amounts by the stabilization (HeldAmounts).
  std::vector<const Field*> held_amounts() const;
  /// Solves without the bounds of the response, which are strongly nonlinear; with them if that does not converge.
  StepStatus solve(const StepTime& step, const Stabilization& stabilization, const Responses& of_waiting);
  /// Whether the values of a solve that has used up its iterations may be used by the iteration around it.
  bool is_good_enough(const StepTime& step);
  std::unique_ptr<Newton> newton_for(const std::vector<Field*>& unknowns) const;

  SolveOptions options_;
  std::vector<Part*> parts_;
  std::vector<Field*> fields_;
  const Mesh& mesh_;
  FieldStore& store_;
  IterationLog log_;
  std::unique_ptr<Newton> newton_;
  std::vector<const Field*> iterated_;         ///< in the iteration around the step
  std::unique_ptr<WaitingResponse> response_;  ///< of a stabilization that contains one; made when data are known
  bool is_response_made_ = false;
  std::unique_ptr<HeldAmounts> amounts_;  ///< where the stabilization holds amounts
  Responses of_amounts_;
  StepTime inexact_in_;  ///< the time step in which solves were inexact
  int inexact_ = 0;      ///< how many of them in a row
};

Spec newton_spec(NewtonOptions& options);  ///< of the section `newton:`
Spec solver_spec(LinearOptions& options);  ///< of the section `solver:`

}  // namespace sprekk
