// What asks a run to end lets it write a checkpoint first.
#pragma once

namespace sprekk {

/// While it exists, Ctrl-C (SIGINT), SIGTERM, the end of the terminal (SIGHUP) and a reader of the output that went
/// away (SIGPIPE) request an interruption; a second SIGINT or SIGTERM ends the program at once, whatever it is doing.
/// SIGHUP stays ignored where it was (nohup).
class InterruptGuard {
 public:
  InterruptGuard();
  /// Gives SIGINT and SIGTERM back. The others stay harmless: what is said about the end may have no reader.
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  /// Whether any process of the run has been asked to end. Collective.
  bool is_interrupted() const;
};

}  // namespace sprekk
