// The last attempt of Newton's method: a path from piece to piece.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "framework/invariants.hpp"
#include "framework/round_off.hpp"
#include "framework/schedule/newton.hpp"
#include "framework/schedule/search_mode_guard.hpp"

namespace sprekk {
namespace {

/// A change of the piece along an update: the state is in the old piece up to the length `before`, and in another one
/// at the length `behind`. Lengths are parts of the update.
struct Crossing {
  double before = 0, behind = 0;
};

/// The first crossing within `limit`, or none. `is_same` says whether a length is still in the piece. In a plane pieces
/// are convex, so if a length is in the piece, all shorter lengths are. In space they need not be (the outside of a
/// cone is not), so lengths are tried from a short one on: a path that turns back at a crossing may leave the piece at
/// once.
template <class IsSame>
std::optional<Crossing> first_crossing(const IsSame& is_same, double limit) {
  constexpr double shortest = 1e-16;                              // of a length: an absolute one, for those that vanish
  constexpr double first = dimension == 2 ? 1 : 1.0 / (1 << 20);  // about the length of a step off kinks, below
  SPREKK_EXPECT(limit > 0, limit);
  Crossing crossing{0, std::min(first, limit)};
  while (is_same(crossing.behind)) {
    if (crossing.behind >= limit) return std::nullopt;
    crossing = {crossing.behind, 2 * crossing.behind};
  }
  while (crossing.behind - crossing.before > rounding::of_terms * crossing.behind + shortest) {
    const double middle = 0.5 * (crossing.before + crossing.behind);
    (is_same(middle) ? crossing.before : crossing.behind) = middle;
  }
  return crossing;
}

}  // namespace

/// Moves the fields off kinks. Cells that slipped last are at a kink, and cells without load at several; from there
/// round-off would decide in which piece a path starts and which piece follows. A path may start anywhere, so it starts
/// beside the kinks. Fields of one unit share a scale: jumps that are zero while everything sticks are compared with
/// displacements.
void Newton::step_off_kinks(const LinearSystem& system, const Vector& update) {
  // Above round-off of the state; by other amounts for each unknown, as multiples of the golden ratio repeat nowhere.
  constexpr double aside = 1e-5;
  SPREKK_EXPECT(update.size() == system_.size(), update.size(), system_.size());
  SPREKK_EXPECT(system.blocks.size() == unknowns_.size(), system.blocks.size(), unknowns_.size());
  const auto change = [&](std::size_t u) {
    return update.segment(system_.first(static_cast<int>(u)), unknowns_[u]->size());
  };
  std::map<std::string, double> scale;
  for (std::size_t u = 0; u < unknowns_.size(); ++u)
    if (unknowns_[u]->size() > 0) {
      double& largest = scale[unknowns_[u]->spec().unit];
      largest = std::max(largest, change(u).lpNorm<Eigen::Infinity>());
    }
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    if (system.blocks[u].kind != BlockKind::interface) continue;
    Vector values = unknowns_[u]->now();
    for (int i = 0; i < values.size(); ++i) {
      const double turns = (i + 1) * (std::numbers::phi - 1);
      values[i] += aside * scale[unknowns_[u]->spec().unit] * (2 * (turns - std::floor(turns)) - 1);
    }
    unknowns_[u]->set(std::move(values));
  }
}

bool Newton::is_solution(const ResidualCheck& check) {
  if (!check.rows_hold) return false;
  Vector next;
  const LinearReport report = linear_->solve(right_hand_side(check), next);
  return report.solved && relative_size(next, check) <= options_.update;
}

StepStatus Newton::follow_path(const StepTime& step, SearchMode mode) {
  constexpr double far = 1e9;  // in lengths of the update: a ray without a crossing up to here has none
  const SearchModeGuard guard(mode, SearchMode::without_shortcuts, pieces_);
  std::set<std::uint64_t> entered;
  std::uint64_t left = 0;    // the last piece before the present one
  bool has_crossed = false;  // since the last whole step
  int whole_steps = 0;
  constexpr int patience = 30;        // pieces without this gain
  double share = 1, least_share = 1;  // s
  int without_gain = 0;
  lost_.reset();
  is_path_stuck_ = false;
  ResidualCheck check = evaluate(step);
  for (int iteration = 0; iteration < options_.pieces; ++iteration) {
    const auto fails = [iteration](const std::string& reason) { return StepStatus{false, reason, iteration + 1}; };
    if (!check.finite) return fails(check.why_not_finite());
    const LinearSystem& system = system_.matrix(*assembly_);
    const LinearReport factoring = linear_->factor(system);
    if (!factoring.solved) return fails("singular system: " + factoring.reason);
    Vector update;
    const LinearReport report = linear_->solve(right_hand_side(check), update);
    if (!report.solved) return fails("linear solver: " + report.reason);
    if (iteration == 0) {
      step_off_kinks(system, update);
      check = evaluate(step);
      entered.insert(discrete_state());
      continue;
    }

    const std::vector<Vector> from = values();
    const std::uint64_t piece = discrete_state();
    const auto is_same = [&](double length) {
      move(from, update, length);
      return discrete_state() == piece;
    };
    std::optional<Crossing> crossing = first_crossing(is_same, 1);
    bool is_reversed = false;
    if (crossing && has_crossed) {
      move(from, update, crossing->behind);
      is_reversed = discrete_state() == left;
    }
    if (is_reversed) {
      // The determinant has changed its sign: s grows from here until the path turns again.
      set(from);
      lost_ = find_loss(step, step.start + (1 - share) * step.dt);
      if (lost_) return fails(lost_->told);
      update = -update;
      crossing = first_crossing(is_same, far);
      if (!crossing) return fails("the path leads to infinity");
    }
    const double length = crossing ? crossing->behind : 1;
    share *= is_reversed ? 1 + length : 1 - length;
    move(from, update, length);
    check = evaluate_trial(step);
    if (!check.finite) continue;
    if (log_)
      log_({step, name_, iteration, check.largest, check.equation, relative_size(update, check),
            is_reversed ? -length : length, check.of_equations});
    if (is_solution(check)) return {true, "", iteration + 1};
    without_gain = share < (1 - rounding::far_above) * least_share ? 0 : without_gain + 1;
    if (without_gain == 0) least_share = share;
    is_path_stuck_ = without_gain == patience;
    if (is_path_stuck_)
      return fails(fmt::format("the path has gained nothing in {} pieces ({:.2g} of the residual is left)", patience,
                               least_share));
    has_crossed = crossing.has_value();
    if (has_crossed) {
      left = piece;
      whole_steps = 0;
      // A straight line enters a convex piece only once.
      if (!entered.insert(discrete_state()).second) return fails("the path comes back to where it was");
    } else if (++whole_steps == options_.at_most) {
      return fails("no convergence in the last piece of the path");
    }
  }
  return {false, fmt::format("the path has more than {} pieces", options_.pieces), options_.pieces};
}

}  // namespace sprekk
