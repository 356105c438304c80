// The interface of a part that counts later what a step has left of a balance.
#pragma once

namespace sprekk {

class Assembly;

/// A part that measures its balances from the amounts that were counted last. What remains of a balance after the last
/// pass of an iteration is then not lost, but carried into the next step.
class CountsLater {
 public:
  virtual ~CountsLater() = default;
  /// To be called after Part::after_solve for all fields. `assembly`: all equations at the end of the passes; it has
  /// the residuals of balances.
  virtual void count_rest_later(const Assembly& assembly) = 0;
};

}  // namespace sprekk
