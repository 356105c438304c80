// The interface of a part that counts later what a step has left of a balance.
#pragma once

namespace sprekk {

class Assembly;

/// A part whose terms of balances are changes since the amounts that were counted last. What the passes of an iteration
/// leave of a balance, by the little that they do not converge, need not be lost: it is counted in the next step.
class CountsLater {
 public:
  virtual ~CountsLater() = default;
  /// To be called after Part::after_solve for all fields. `assembly`: all equations at the end of the passes; it has
  /// the residuals of balances.
  virtual void count_rest_later(const Assembly& assembly) = 0;
};

}  // namespace sprekk
