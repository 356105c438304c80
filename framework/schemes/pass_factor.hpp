// How much a pass of an iterated scheme leaves of small errors, from the equations of one time step.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/schedule/waiting_response.hpp"
#include "framework/schemes/scheme.hpp"

namespace sprekk {

/// The Jacobian A of all equations of a step. A pass of a scheme multiplies small errors by I − M⁻¹A, where M is A
/// without the blocks that the scheme takes from the pass before, and with the stabilization. A group with the Schur
/// complement of waiting unknowns takes its part of a step of Newton's method for all equations, A⁻¹.
class PassFactor {
 public:
  /// Of the state in which the model is, which has to be that at the end of the step. One process.
  PassFactor(const Model& model, const StepTime& step);
  ~PassFactor();
  /// The largest absolute eigenvalue of I − M⁻¹A, by power iteration; nothing where a group alone is singular.
  std::optional<double> of(const Scheme& scheme);

 private:
  class Group;
  const Group* group(const std::vector<std::string>& components, const std::string& stabilization);

  /// The terms that a stabilization with held amounts adds to the equations of a group.
  std::vector<ResponseTerm> terms_of_held_amounts(const std::vector<std::string>& components,
                                                  const std::string& stabilization) const;

  const Model& model_;
  StepTime step_;
  std::vector<const Field*> unknowns_;
  std::vector<int> first_;
  SparseMatrix matrix_;
  std::map<std::string, std::unique_ptr<Group>> groups_;
};

}  // namespace sprekk
