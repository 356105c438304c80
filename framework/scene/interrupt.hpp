// Ctrl-C ends a run after its current step, with a checkpoint.
#pragma once

namespace sprekk {

/// While it exists, SIGINT and SIGTERM set a flag. A second one ends the program at once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  /// Whether any process of the run has received one. Collective.
  bool is_interrupted() const;
};

}  // namespace sprekk
