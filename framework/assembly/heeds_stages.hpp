// Parts to which two stages of a step make a difference.
#pragma once

#include <string>

namespace sprekk {

/// Capability: a part that heeds whether a step has two stages (TimeScheme::sdirk2).
class HeedsStages {
 public:
  virtual ~HeedsStages() = default;
  /// Whether the steps from now on are stages. Where stored amounts depend on the path of the unknowns within a step,
  /// the path is none of the solution in a stage, since it may start from extrapolated values: there the part stores
  /// changes of its unknowns times coefficients at the end.
  virtual void take_stages(bool /*are_stages*/) {}
  /// What one stage costs in accuracy, as the rest of a sentence that begins with "with backward_euler", where two
  /// stages are recommended; empty where one stage costs too little for a note.
  virtual std::string loss_of_one_stage() const { return ""; }
};

}  // namespace sprekk
