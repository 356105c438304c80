#include "framework/scene/interrupt.hpp"

#include <csignal>

#include "framework/parallel/parallel.hpp"

namespace sprekk {

namespace {

volatile std::sig_atomic_t interrupted = 0;

void handle(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted = 0;
  std::signal(SIGINT, handle);
  std::signal(SIGTERM, handle);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::is_interrupted() const { return parallel::any(interrupted != 0); }

}  // namespace sprekk
