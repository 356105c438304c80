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
  /// The lowest change that the Schur complement may make to each value of a row, 0 or negative: waiting unknowns
  /// follow to a bound and no further (walls that close come into contact). Empty for no bound. The equation of such a
  /// row has the derivative 1 by the row's own field. The term vanishes with convergence, so the bound changes no
  /// answer.
  virtual Vector least_change(const Field& /*row*/) const { return {}; }
};

}  // namespace sprekk
