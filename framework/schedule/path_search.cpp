// The path from piece to piece to which Newton's method falls back.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "framework/schedule/newton.hpp"

namespace sprekk {
namespace {

/// Where along an update the piece changes: it is the old one up to `before` and another at `behind`, in lengths of the
/// update.
struct Crossing {
  double before = 0, behind = 0;
};

/// The first crossing within `limit`, or none. `is_same` says whether a length is still in the piece: pieces are
/// convex, so that one end in it has all between in it.
template <class IsSame>
std::optional<Crossing> first_crossing(const IsSame& is_same, double limit) {
  constexpr double sharpness = 1e-13;
  Crossing crossing{0, std::min(1.0, limit)};
  while (is_same(crossing.behind)) {
    if (crossing.behind >= limit) return std::nullopt;
    crossing = {crossing.behind, 2 * crossing.behind};
  }
  while (crossing.behind - crossing.before > sharpness * crossing.behind) {
    const double middle = 0.5 * (crossing.before + crossing.behind);
    if (middle <= crossing.before || middle >= crossing.behind) break;
    (is_same(middle) ? crossing.before : crossing.behind) = middle;
  }
  return crossing;
}

}  // namespace

StepStatus Newton::follow_path(const StepTime& step) {
  constexpr double far = 1e9;       // lengths of the update: a ray that has met no other piece meets none
  constexpr double at_once = 1e-7;  // a piece that is left so soon has only been touched
  constexpr int visits = 2;         // of one piece: more is going round in circles
  std::map<std::uint64_t, int> entered;
  std::uint64_t left = 0;    // the piece that was left last
  bool has_crossed = false;  // since the last whole step
  int whole_steps = 0;
  ResidualCheck check = look(step);
  for (int iteration = 0; iteration < options_.pieces; ++iteration) {
    const auto fails = [iteration](const std::string& reason) { return StepStatus{false, reason, iteration}; };
    if (!check.finite) return fails("the residual of " + check.equation + " is not finite");
    const LinearReport factoring = linear_->factor(system_.matrix(*assembly_));
    if (!factoring.solved) return fails("singular system: " + factoring.reason);
    Vector update;
    const LinearReport report = linear_->solve(right_hand_side(check), update);
    if (!report.solved) return fails("linear solver: " + report.reason);

    const std::vector<Vector> from = values();
    const std::uint64_t piece = discrete_state();
    const auto is_same = [&](double length) {
      move(from, update, length);
      return discrete_state() == piece;
    };
    std::optional<Crossing> crossing = first_crossing(is_same, 1);
    bool is_reversed = false;
    if (crossing && has_crossed && crossing->behind < at_once) {
      move(from, update, crossing->behind);
      is_reversed = discrete_state() == left;
    }
    if (is_reversed) {
      // The determinant has changed its sign: from here the path leads away from the solution before it comes back.
      update = -update;
      crossing = first_crossing(is_same, far);
      if (!crossing) return fails("the path leads to no solution (a ray)");
    }
    const double length = crossing ? crossing->behind : 1;
    move(from, update, length);
    check = look(step);
    if (log_)
      log_({step, name_, iteration + 1, check.largest, check.equation, relative_size(update, check),
            is_reversed ? -length : length});
    has_crossed = crossing.has_value();
    if (has_crossed) {
      left = piece;
      whole_steps = 0;
      if (++entered[discrete_state()] > visits) return fails("the path goes round in circles");
      continue;
    }
    if (check.converged) {
      Vector next;
      const LinearReport last = linear_->solve(right_hand_side(check), next);
      if (last.solved && relative_size(next, check) <= options_.update) return {true, "", iteration + 1};
    }
    if (++whole_steps == options_.at_most) return fails("no convergence in the last piece of the path");
  }
  return {false, fmt::format("the path has more than {} pieces", options_.pieces), options_.pieces};
}

}  // namespace sprekk
