// Signals that end a run after it has written a checkpoint.
#pragma once

namespace sprekk {

/// A guard: while it exists, Ctrl-C (SIGINT), SIGTERM, the end of the terminal (SIGHUP) and a closed output pipe
/// (SIGPIPE) request an interruption. A second SIGINT or SIGTERM ends the program at once. SIGHUP stays ignored where
/// it was ignored before (nohup).
class InterruptGuard {
 public:
  InterruptGuard();
  /// Gives SIGINT and SIGTERM their default handlers. SIGHUP and SIGPIPE are ignored: the reader of the messages at the
  /// end of the run may be gone.
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  /// Whether any process of the run has been asked to end. Collective.
  bool is_interrupted() const;
};

}  // namespace sprekk
