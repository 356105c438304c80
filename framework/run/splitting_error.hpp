// How far a split without iteration is from the solution in which all parts of a step agree.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/scene/model.hpp"

namespace sprekk {

/// Estimates the splitting error of a run whose schedule solves in turn without iterating. Beside the run goes a second
/// solution: in each step one more pass of the schedule, from its own state at the start of the step, in which the
/// fields that wait have the values that the run has found for the end of the step (a deferred correction). Let a pass
/// turn an error e of the waiting fields into C e. Where e is the error of the run, the second solution has the error
/// C e, and the distance of the two is (1 − C) e. A drained split has C = −alpha^2/(M S) at most, which lies between 0
/// and −1 wherever it is stable without iterating: the distance over √2 is within a factor √2 of the error of a mode.
///
/// A fracture cell that has left a state of contact by mistake does not return to it, so with fractures the second
/// solution has to be nearer: waiting fields have the values between both ends of the step at which a split with
/// C = −1/2 would leave them. The second solution then has the error C (1 + 2 C)/3 e, for 0 > C > −1 at most a third of
/// e, and the distance is the estimate.
class SplittingError {
 public:
  /// Does nothing where the scene does not want it, or where its schedule does not solve in turn in any step of the
  /// run (looked at at many times).
  explicit SplittingError(const Model& model);

  /// `mesh_changes`: of the run so far. After a change the second solution begins anew, and the errors found before
  /// count on.
  void observe(long mesh_changes);
  /// When a step has converged, before it is accepted.
  void before_acceptance(const Model& model, const StepTime& step);
  bool is_due() const { return !second_.empty(); }
  /// After the step has been accepted, where that is due. The model keeps the accepted state.
  void after_acceptance(Model& model, const StepTime& step);

  /// For history.csv: the largest error of a field over its largest value, and the largest residual of any equation
  /// over its terms, with all equations of the step taken together.
  std::vector<Quantity> quantities() const;
  /// By the names of the solved fields, over the largest value of each; empty where nothing was estimated.
  const std::map<std::string, double>& of_fields() const { return errors_; }
  void note_step(Notes& notes) const;

  /// State for checkpoints.
  void save(const Model& model, std::map<std::string, Vector>& state) const;
  void restore(const Model& model, const std::map<std::string, Vector>& state);

 private:
  void begin_anew();
  using Values = std::vector<Vector>;  ///< of all fields
  Values waiting(const Model& model, const StepTime& step, const Values& accepted) const;
  void compare(const Model& model, const Values& accepted);

  bool is_wanted_;
  long mesh_changes_ = 0;
  int failures_ = 0;
  Values second_;                          ///< the second solution at the end of the last step, all fields; or empty
  Values before_;                          ///< the run's own at the start of the step
  std::map<std::string, double> largest_;  ///< value of each solved field so far
  std::map<std::string, double> former_;   ///< errors from before the second solution has begun anew
  std::map<std::string, double> errors_;   ///< of the solved fields, over their largest values
  double error_ = 0, coupled_residual_ = 0;
  std::string worst_field_;
};

}  // namespace sprekk
