// The attempts of Newton's method at a step: the quickest first, the surest last
// (docs/numerics/coupling_and_time.md#newton).
#include <fmt/format.h>

#include <algorithm>

#include "framework/schedule/newton.hpp"
#include "framework/schedule/search_mode_guard.hpp"

namespace sprekk {

StepStatus Newton::search(const StepTime& step, const std::vector<Vector>& start) {
  state_has_changed_ = false;
  // 1. Full steps, as active sets usually settle by themselves.
  StepStatus status = attempt_also_without_conditions(step, start, Until::search);
  if (status.converged) return status;
  const SearchModeGuard guard(SearchMode::without_shortcuts, SearchMode::with_shortcuts, pieces_);
  const auto try_again = [&](const auto& rung) {
    set(start);
    const int before = status.iterations;
    status = rung();
    status.iterations += before;
  };
  // 2. Without the shortcuts of parts, and with a line search from some iteration on.
  if (was_left_)
    try_again(
        [&] { return finish_with_own_derivatives(step, attempt_also_without_conditions(step, start, Until::end)); });
  if (status.converged || status.iterations <= 1) return status;
  // 3. Descent from the first iteration on, since no descent may lead back from where full steps have led.
  if (options_.undamped > 0) try_again([&] { return finish_with_own_derivatives(step, iterate(step, 0)); });
  if (status.converged || options_.pieces == 0 || !(state_has_changed_ || is_nonlinear_in_pieces())) return status;
  // 4. The path from piece to piece.
  return follow_paths(step, start, std::move(status));
}

/// If the system is singular, because nothing determines some unknown in the present discrete state, a further attempt
/// starts from fields whose conditions are inactive (PiecewiseSmooth::deactivate_conditions).
StepStatus Newton::attempt_also_without_conditions(const StepTime& step, const std::vector<Vector>& start,
                                                   Until until) {
  StepStatus tried = iterate(step, options_.undamped, until);
  if (tried.converged || !was_singular_) return tried;
  const int before = tried.iterations;
  set(start);
  for (PiecewiseSmooth* part : pieces_) part->deactivate_conditions();
  tried = iterate(step, options_.undamped, until);
  tried.iterations += before;
  return tried;
}

bool Newton::is_nonlinear_in_pieces() const {
  return std::ranges::any_of(pieces_, [](const PiecewiseSmooth* part) { return part->is_nonlinear_in_pieces(); });
}

/// Without shortcuts, parts that are nonlinear in pieces approach the solution reliably but slowly. Near the solution
/// their own derivatives converge fast.
StepStatus Newton::finish_with_own_derivatives(const StepTime& step, StepStatus status) {
  if (status.converged || !is_used_up_ || !is_nonlinear_in_pieces()) return status;
  const SearchModeGuard own(SearchMode::piecewise, SearchMode::without_shortcuts, pieces_);
  StepStatus finished = iterate(step, options_.undamped);
  finished.iterations += status.iterations;
  return finished;
}

/// The path is followed with coefficients held, then corrected with the true coefficients, which are released in stages
/// if that fails; at last it is followed with all derivatives.
StepStatus Newton::follow_paths(const StepTime& step, const std::vector<Vector>& start, StepStatus status) {
  const bool is_used_up = is_used_up_;
  const std::vector<Vector> tried = values();
  for (const SearchMode mode : {SearchMode::piecewise_linear, SearchMode::piecewise}) {
    set(start);
    StepStatus path = follow_path(step, mode);
    status.iterations += path.iterations;
    if (lost_ && mode == SearchMode::piecewise) {
      status.reason = lost_->told;
      status.lost_at = lost_->time;
      status.is_hopeless = least_iterations_ == 0;  // in an iteration other unknowns are held
      break;
    }
    // Iterates from the end of the path with the true coefficients, until balances hold.
    if (path.converged) {
      const std::vector<Vector> end = values();
      path = iterate(step, options_.undamped);
      status.iterations += path.iterations;
      if (!path.converged && mode == SearchMode::piecewise_linear) {
        const std::string reason = path.reason;
        set(end);
        path = release_coefficients(step, start);
        path.reason = reason + "; then " + path.reason;
        status.iterations += path.iterations;
      }
    }
    if (path.converged) return {true, "", status.iterations};
    status.reason += "; then " + path.reason;
    if (is_path_stuck_) break;  // with other derivatives its pieces are the same
  }
  if (is_used_up) set(tried);
  is_used_up_ = is_used_up;
  return status;
}

/// Coefficients c_0^(1 - share) c^share, for shares that grow from 0, where the path has ended, to 1. Each solution is
/// the start for the next share. After a failure the increment of the share is halved, after a success doubled.
StepStatus Newton::release_coefficients(const StepTime& step, const std::vector<Vector>& start) {
  constexpr double first = 0.25, smallest = 1.0 / 64;  // shares of the coefficients, at first and at least
  std::vector<Vector> reached = values();
  set(start);
  for (PiecewiseSmooth* part : pieces_) part->release_coefficients(0);
  set(reached);
  int iterations = 0;
  double share = 0, increment = first;
  std::string reason;
  while (share < 1 && increment >= smallest) {
    const double next = std::min(1.0, share + increment);
    for (PiecewiseSmooth* part : pieces_) part->release_coefficients(next);
    const StepStatus status = iterate(step, options_.undamped);
    iterations += status.iterations;
    if (status.converged) {
      share = next;
      increment *= 2;
      if (share < 1) reached = values();
    } else {
      reason = status.reason;
      increment = 0.5 * (next - share);
      set(reached);
    }
  }
  for (PiecewiseSmooth* part : pieces_) part->release_coefficients(1);
  if (share == 1) return {true, "", iterations};
  return {
      false,
      fmt::format("the coefficients could be released from their values at the start up to a share of {:.2g} only: {}",
                  share, reason),
      iterations};
}

}  // namespace sprekk
