// The step from one trial of a search for a front to the next one.
#include <algorithm>
#include <cmath>

#include "components/fine_fracture/growth/front.hpp"
#include "components/fine_fracture/growth/front_limits.hpp"
#include "components/fine_fracture/growth/linear_front.hpp"
#include "framework/dense/lu.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double quarter_turn = 1.5;     ///< rad: for a move that turns further the slope of K_II is wrong
constexpr double largest_factor = 3;     ///< between lengths of a new segment in two trials
constexpr double largest_advance = 0.6;  ///< of an increment, between two trials
constexpr double no_motion = 1e-300;     ///< no division by zero

}  // namespace

/// The step with the learnt slopes: loads and directions are linearized, and the equations of the front are solved
/// exactly for them; if they have no solution, they are linearized, too.
Eigen::VectorXd Front::newton_step(const std::vector<int>& free, const Eigen::VectorXd& residual) {
  if (const auto move = step_to_linear_front(free, residual)) return *move;
  const std::vector<int> tips = front_tips();
  const FrontEquations front = equations(residual);
  const auto matrix_of_front = [&] {
    Eigen::MatrixXd jacobian = slopes_.jacobian;
    for (std::size_t a = 0; a < tips.size(); ++a) {
      jacobian.row(2 * tips[a]).setZero();
      for (std::size_t b = 0; b < tips.size(); ++b) {
        const auto row = static_cast<Eigen::Index>(a), column = static_cast<Eigen::Index>(b);
        jacobian.row(2 * tips[a]) += front.by_load(row, column) * slopes_.jacobian.row(2 * tips[b]);
        jacobian(2 * tips[a], 2 * tips[b]) += front.by_advance(row, column);
      }
    }
    return Eigen::MatrixXd(jacobian(free, free));
  };
  Eigen::MatrixXd matrix = matrix_of_front();
  if (!FullPivotingLu(matrix).is_invertible()) {
    // Slopes of zero (loads that seemed not to depend on lengths) would leave the tips where they are.
    forget();
    matrix = matrix_of_front();
  }
  return FullPivotingLu(matrix).solve(-count_loads(residual, front)(free));
}

bool Front::is_at_longest(int tip, const Eigen::VectorXd& residual) const {
  return options_.holds_state && residual[2 * tip] > 0 && length_[tip] >= tips_[tip].longest * (1 - at_limit);
}

bool Front::is_held(int unknown, const Eigen::VectorXd& residual) const {
  const int tip = unknown / 2;
  return unknown % 2 == 1 ? tips_[tip].has_angle : tips_[tip].has_length || is_at_longest(tip, residual);
}

/// A new segment in a wrong direction may not tell whether it is too long. To second order K_eq is K (1 + phi^2), with
/// phi = atan(K_II/K_I) and the K of the right direction.
bool Front::tells_of_length(int tip, const Eigen::VectorXd& residual) const {
  const double phi = residual[2 * tip + 1];
  return !is_new(tip) || !options_.holds_state || tips_[tip].has_angle ||
         std::abs(phi) <= options_.direction_tolerance || phi * phi <= std::abs(residual[2 * tip]);
}

std::vector<int> Front::held_unknowns(const Eigen::VectorXd& residual) const {
  std::vector<int> held;
  for (int i = 0; i < count(); ++i) {
    if (grows_[i] && (is_held(2 * i, residual) || !tells_of_length(i, residual))) held.push_back(2 * i);
    if (grows_[i] && is_held(2 * i + 1, residual)) held.push_back(2 * i + 1);
  }
  return held;
}

Eigen::VectorXd Front::step_without(const std::vector<int>& held, const std::vector<int>& free,
                                    const Eigen::VectorXd& residual) {
  const Eigen::MatrixXd learnt = slopes_.jacobian;
  Eigen::VectorXd left = residual;
  for (const int unknown : held) {
    slopes_.jacobian.row(unknown).setZero();
    slopes_.jacobian.col(unknown).setZero();
    slopes_.jacobian(unknown, unknown) = 1;
    left[unknown] = 0;
  }
  Eigen::VectorXd move = newton_step(free, left);
  slopes_.jacobian = learnt;
  return move;
}

/// The move by which all directions and the lengths of new segments follow the lengths of the other tips, and these
/// lengths are those of the front.
std::optional<Eigen::VectorXd> Front::step_to_linear_front(const std::vector<int>& free,
                                                           const Eigen::VectorXd& residual) const {
  const std::vector<int> tips = front_tips();
  if (tips.empty()) return std::nullopt;
  std::vector<int> lengths, others;
  for (const int tip : tips) lengths.push_back(2 * tip);
  for (const int unknown : free)
    if (std::ranges::find(lengths, unknown) == lengths.end()) others.push_back(unknown);
  const Eigen::MatrixXd& jacobian = slopes_.jacobian;
  const FullPivotingLu factors(jacobian(others, others));
  if (!factors.is_invertible()) return std::nullopt;
  const Eigen::MatrixXd follow = -factors.solve_columns(Eigen::MatrixXd(jacobian(others, lengths)));
  const Eigen::VectorXd own = -factors.solve(Eigen::VectorXd(residual(others)));
  const Eigen::VectorXd at = advances(tips);
  const auto advances = linear_front({residual(lengths) + jacobian(lengths, others) * own,
                                      jacobian(lengths, lengths) + jacobian(lengths, others) * follow, at},
                                     options_.mesh_error);
  if (!advances) return std::nullopt;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(residual.size());
  const Eigen::VectorXd of_lengths = *advances - at, of_others = own + follow * of_lengths;
  for (std::size_t i = 0; i < lengths.size(); ++i) all[lengths[i]] = of_lengths[static_cast<Eigen::Index>(i)];
  for (std::size_t i = 0; i < others.size(); ++i) all[others[i]] = of_others[static_cast<Eigen::Index>(i)];
  return Eigen::VectorXd(all(free));
}

/// With the state held: keeps the angle and, if the excess is given, the length within their brackets.
void Front::step_between(int i, std::optional<double> excess) {
  const bool is_right = tips_[i].has_angle || std::abs(before_residual_[2 * i + 1]) <= options_.direction_tolerance;
  if (!is_right && !turn_between(i, before_place_[2 * i + 1])) {
    if (may_shorten(i))
      return shorten(i, longest_part, -std::max(options_.load_tolerance, brackets_[i].shorter.excess));
    verdict_ = Verdict::failed;
    reason_ = "no direction makes K_II vanish";
  } else if (excess) {
    learn_length(i, *excess);
    const double wanted = std::max(least(i), length_between(i));
    turn_with_length(i, wanted);
    length_[i] = wanted;
  }
}

/// Newton's step. A tip that would move back to where it was at the start of the step rests there.
void Front::step(const Eigen::VectorXd& residual) {
  if (free_tips(residual)) return;
  const Eigen::VectorXd from = place();
  std::vector<int> free;
  for (int i = 0; i < count(); ++i)
    if (grows_[i]) free.insert(free.end(), {2 * i, 2 * i + 1});
  const int size = static_cast<int>(free.size());
  const std::vector<int> given = held_unknowns(residual);
  std::vector<int> held = given;
  for (int i = 0; i < count(); ++i)
    if (grows_[i] && has_bracket(i) && std::ranges::find(given, 2 * i) == given.end()) held.push_back(2 * i);
  Eigen::VectorXd move = step_without(held, free, residual);
  const std::size_t before = held.size();
  for (int a = 1; a < size; a += 2)
    if (std::abs(move[a]) > quarter_turn && std::ranges::find(held, free[a] - 1) == held.end()) held.push_back(free[a]);
  if (held.size() > before) move = step_without(held, free, residual);
  const Eigen::VectorXd counted = count_loads(residual, equations(residual));
  double part = part_;
  for (int a = 0; a < size; a += 2) {
    const int i = free[a] / 2;
    if (!std::isfinite(move[a]) || !std::isfinite(move[a + 1]))
      move[a] = counted[free[a]] > 0 ? 0.5 : -0.5, move[a + 1] = 0;
    part = std::min(part, largest_turn / std::max(no_motion, std::abs(move[a + 1])));
    if (has_bracket(i)) continue;
    part = std::min(part, largest_advance / std::max(no_motion, std::abs(move[a])));
    if (is_new(i)) {
      const double factor = 1 + move[a] * options_.increment / length_[i];
      if (factor > largest_factor) part = std::min(part, (largest_factor - 1) / (factor - 1));
      if (factor < 1 / largest_factor) part = std::min(part, (1 - 1 / largest_factor) / (1 - factor));
    }
  }
  before_place_ = from;
  before_residual_ = residual;
  for (int a = 0; a < size; a += 2) {
    const int i = free[a] / 2;
    const double wanted = length_[i] + part * move[a] * options_.increment;
    angle_[i] += part * move[a + 1];
    if (has_bracket(i)) {
      const bool is_given = std::ranges::find(given, free[a]) != given.end();
      step_between(i, is_given ? std::nullopt : std::optional(counted[2 * i]));
      continue;
    }
    if (wanted <= least(i)) {
      // A tip that is back at the start of the step rests, unless it is above its toughness there: then its load rises
      // with its length.
      const bool is_unstable = counted[2 * i] > 0 && length_[i] <= least(i) * (1 + at_limit);
      if (is_unstable && was_unstable_[i]) {
        verdict_ = Verdict::failed;
        reason_ = "the load of a tip rises with its length";
        return;
      }
      was_unstable_[i] = was_unstable_[i] || is_unstable;
      length_[i] = least(i) + (is_unstable ? first_part * options_.increment : 0);
      if (!is_new(i))
        angle_[i] = tips_[i].angle;
      else if (tips_[i].least > 0)
        angle_[i] = tips_[i].first_angle;  // the direction of the part that exists already
      grows_[i] = is_unstable;
      best_.reset();
    } else {
      length_[i] = wanted;
    }
    if (length_[i] > tips_[i].longest) {
      if (counted[2 * i] > 0 && from[2 * i] * options_.increment >= tips_[i].longest * (1 - at_limit)) {
        verdict_ = Verdict::too_far;
        reason_ = "a tip grows further than its longest advance in one step";
        return;
      }
      length_[i] = tips_[i].longest;
    }
  }
}

}  // namespace sprekk::fine_fracture
