// What a part is whose field follows another one through unknowns that a split lets wait.
#pragma once

#include <string>
#include <vector>

#include "framework/field/field.hpp"

namespace sprekk {

/// The equation of `row` contains unknowns that wait while `row` and `column` are solved for, and these unknowns follow
/// `column`.
struct Following {
  const Field *row, *column;
};

/// "I know a field that answers another one of its own solve, through unknowns of a later one."
class FollowsWaiting {
 public:
  virtual ~FollowsWaiting() = default;
  /// The pairs of fields whose response a stabilization contains (see WaitingResponse).
  virtual std::vector<Following> following(const std::string& stabilization) const = 0;
};

}  // namespace sprekk
