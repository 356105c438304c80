#include "framework/run/interrupt.hpp"

#include <csignal>

#include "framework/parallel/interruption.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

namespace {

volatile std::sig_atomic_t asked_by_hand = 0;

/// SIGINT and SIGTERM: the second of them, of either kind, has its usual effect.
void handle(int signal) {
  if (asked_by_hand != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  asked_by_hand = 1;
  interruption::request();
}

/// A terminal that closes may send several signals.
void handle_loss(int) { interruption::request(); }

bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void set_handler(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  asked_by_hand = 0;
  interruption::forget();
  set_handler(SIGINT, handle);
  set_handler(SIGTERM, handle);
  for (const int signal : {SIGHUP, SIGPIPE})
    if (!is_ignored(signal)) set_handler(signal, handle_loss);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

bool InterruptGuard::is_interrupted() const { return parallel::any(interruption::is_requested()); }

}  // namespace sprekk
