#include "framework/parallel/interruption.hpp"

#include <csignal>

#include "framework/parallel/parallel.hpp"

namespace sprekk::interruption {
namespace {

volatile std::sig_atomic_t requested = 0;
int allowed = 0;

}  // namespace

void request() { requested = 1; }
bool is_requested() { return requested != 0; }
void forget() { requested = 0; }

Allowed::Allowed() { ++allowed; }
Allowed::~Allowed() { --allowed; }

void poll() {
  if (allowed > 0 && parallel::any(is_requested())) throw Interrupted{};
}

void poll_alone() {
  if (allowed > 0 && is_requested() && parallel::size() == 1) throw Interrupted{};
}

}  // namespace sprekk::interruption
