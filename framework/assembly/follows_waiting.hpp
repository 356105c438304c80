// The interface of a part that has a field which depends on another one through unknowns that a split holds.
#pragma once

#include <string>
#include <vector>

#include "framework/field/field.hpp"

namespace sprekk {

/// The equation of `row` contains unknowns that wait (are held) while `row` and `column` are solved for, and the
/// equations of these unknowns contain `column`.
struct Following {
  const Field *row, *column;
};

/// A part that names fields whose coupling goes through unknowns of a later solve.
class FollowsWaiting {
 public:
  virtual ~FollowsWaiting() = default;
  /// The pairs of fields for which a stabilization adds the Schur complement of the waiting unknowns (WaitingResponse).
  virtual std::vector<Following> following(const std::string& stabilization) const = 0;
};

}  // namespace sprekk
