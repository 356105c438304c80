// Interruption: a run that is asked to end does so soon, also in the middle of a long step.
#pragma once

namespace sprekk {

/// Thrown between iterations of an attempt that is to be given up. This is no std::exception, so that no handler takes
/// it for a failure of the attempt. Whoever catches it rewinds the attempt.
struct Interrupted {};

namespace interruption {

/// Asks the run to end. Safe in signal handlers.
void request();
bool is_requested();  ///< in this process
void forget();        ///< takes all requests in this process back

/// A guard: `poll` may throw as long as one of these objects exists.
class Allowed {
 public:
  Allowed();
  ~Allowed();
  Allowed(const Allowed&) = delete;
  Allowed& operator=(const Allowed&) = delete;
};

/// For loops that all processes go through together: throws Interrupted where that is allowed and any process has been
/// asked to end. Collective.
void poll();
/// For loops that a process may go through alone: nothing happens in runs of several processes.
void poll_alone();

}  // namespace interruption
}  // namespace sprekk
