// The interface of a part that stores amounts which are no linear functions of its unknowns.
#pragma once

namespace sprekk {

/// A part whose stored amounts depend on the path of its unknowns within a step. In a stage of a scheme of second order
/// (TimeScheme::sdirk2) the path is none of the solution, since the stage may start from extrapolated values: there the
/// part stores changes of its unknowns times coefficients at the end.
class FollowsStages {
 public:
  virtual ~FollowsStages() = default;
  /// Whether the steps from now on are stages.
  virtual void take_stages(bool are_stages) = 0;
};

}  // namespace sprekk
