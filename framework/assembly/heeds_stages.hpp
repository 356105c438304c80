// Parts to which two stages of a step make a difference.
#pragma once

#include <string>

namespace sprekk {

/// Capability: a part that heeds whether a step has two stages (TimeScheme::sdirk2).
class HeedsStages {
 public:
  virtual ~HeedsStages() = default;
  /// Whether the steps from now on are stages. A stage may start from extrapolated values, so the path of the unknowns
  /// within it is not that of the solution. A part whose stored amounts depend on this path then stores changes of its
  /// unknowns times coefficients at the end.
  virtual void take_stages(bool /*are_stages*/) {}
  /// Why stages of all that the part joins have to be those of the same steps, as the reason of a message; empty where
  /// substeps of some do no harm.
  virtual std::string need_of_one_clock() const { return ""; }
  /// What one stage costs in accuracy, as the rest of a sentence that begins with "with backward_euler", where two
  /// stages are recommended; empty where one stage costs too little for a note.
  virtual std::string loss_of_one_stage() const { return ""; }
};

}  // namespace sprekk
