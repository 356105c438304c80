#include "components/fine_fracture/growth/front.hpp"

#include <algorithm>
#include <cmath>

#include "components/fine_fracture/growth/front_limits.hpp"
#include "components/fine_fracture/growth/kink.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double least_first_advance = 0.05;  ///< of an increment: a shorter one gives no slope from two meshes
constexpr double least_warm_advance = 1e-3;   ///< of an increment, where a slope is known
constexpr double gain = 0.5;                  ///< of the norm of the best trial: what counts as progress
constexpr double noise = 1e-5;                ///< of that norm: steps of the factors that no mesh error explains
constexpr int patience_with_noise = 4;        ///< trials without progress, below it
constexpr int patience = 8;                   ///< trials without progress
constexpr double much_worse = 2;              ///< of the norm of a trial over the best so far
constexpr double closed = 2.4;                ///< rad, |atan2(K_II, K_I)|: above, K_II does not tell the direction
constexpr double shortest_part = 0.1;         ///< of the length of a closed segment: what is tried next, at least
constexpr double margin = 2e-3;               ///< of the width of a bracket: trials nearer to an end hardly help
constexpr double closed_bracket = 2e-3;       ///< of its longer length: in a narrower one an end no longer holds
constexpr double of_meshes = 0.01;            ///< ln K: ten times what it differs by between two meshes
constexpr double shorter = 0.5;               ///< steps after a trial that was much worse
constexpr double of_direction = 0.1;          ///< the weight of K_II/K_I beside ln K_eq/K_IC in that norm
/// Of H by an advance, see most_equal_front.hpp: slopes of loads are 0.3 for short wings.
constexpr double slope_of_differences = 0.01;
constexpr double least_of_difference = 1;  ///< the least weight of differences of advances in that norm
constexpr double of_differences = 0.03;    ///< the tolerance of differences of advances over that of loads

}  // namespace

Front::Front(std::vector<FrontTip> tips, const std::vector<FrontState>& without_growth, const FrontOptions& options,
             double dt, const Eigen::MatrixXd& slopes)
    : tips_(std::move(tips)),
      options_(options),
      dt_(dt),
      grows_(tips_.size(), 0),
      is_laid_(tips_.size(), 0),
      is_stopped_(tips_.size(), 0),
      was_unstable_(tips_.size(), 0),
      length_(tips_.size(), 0),
      angle_(tips_.size(), 0),
      last_(without_growth),
      start_(without_growth) {
  SPREKK_EXPECT(without_growth.size() == tips_.size(), without_growth.size(), tips_.size());
  SPREKK_EXPECT(options_.increment > 0 && options_.shortest > 0, options_.increment, options_.shortest);
  for (int i = 0; i < count(); ++i) {
    length_[i] = tips_[i].covered;
    angle_[i] = tips_[i].angle;
    brackets_.push_back({{0, excess(start_[i])}, {}, {}, {}, {}});
    forget_angles(i);
  }
  make_jacobian();
  is_warm_ = slopes.rows() == 2 * count();
  for (int i = 0; i < count(); ++i)
    if (is_warm_ && !is_new(i))
      slopes_.jacobian(2 * i, 2 * i) =
          slopes(2 * i, 2 * i) * (tips_[i].size > 0 ? std::pow(options_.increment / tips_[i].size, by_size) : 1);
  for (int i = 0; i < count(); ++i)
    if (tips_[i].goes_on || tips_[i].first_length > 0 || (without_growth[i].is_evaluated && without_growth[i].load > 1))
      begin(i, without_growth[i]);
  if (!any_grows()) verdict_ = Verdict::found;
  if (is_warm_) {
    slopes_.jacobian = slopes;
    scale(slopes_.jacobian, without_growth, false);
    weigh_differences();
    return;
  }
  for (int i = 0; i < count(); ++i)
    if (grows_[i]) set_turn_slope(i, without_growth[i].sifs);
  if (!learns_from_start()) return;
  const std::vector<double> lengths = length_, angles = angle_;
  for (int i = 0; i < count(); ++i) length_[i] = tips_[i].covered, angle_[i] = tips_[i].angle;
  before_place_ = place();
  before_residual_ = residual(without_growth);
  length_ = lengths;
  angle_ = angles;
}

/// In the norm of a trial an error in the equations for differences of advances, and one in a load, count alike if they
/// are worth the same advance of all tips.
void Front::weigh_differences() {
  double steepest = 0;
  for (int i = 0; i < count(); ++i) {
    double slope = 0;
    for (int j = 0; j < count(); ++j)
      if (grows_[j] && !is_new(j)) slope += slopes_.jacobian(2 * i, 2 * j);
    if (grows_[i] && !is_new(i)) steepest = std::max(steepest, std::abs(slope));
  }
  if (steepest > 0)
    of_difference_ = std::clamp(steepest / slope_of_differences, least_of_difference, most_of_difference);
}

/// Whether the state without growth is a trial that Broyden's method may learn from: where segments go on, and by so
/// much that the difference of K_eq between two meshes does not matter.
bool Front::learns_from_start() const {
  double longest = 0;
  for (int i = 0; i < count(); ++i) {
    if (tips_[i].goes_on || (grows_[i] && is_new(i))) return false;
    longest = std::max(longest, length_[i] - tips_[i].covered);
  }
  return longest > least_first_advance * options_.increment;
}

bool Front::any_grows() const {
  return std::any_of(grows_.begin(), grows_.end(), [](char grows) { return grows != 0; });
}

void Front::stop(int tip) {
  SPREKK_EXPECT(is_index(tip, count()), tip);
  is_stopped_[tip] = 1;
  grows_[tip] = is_laid_[tip] = 0;
  length_[tip] = tips_[tip].covered;
  angle_[tip] = tips_[tip].angle;
  before_place_.resize(0);
}

void Front::begin_with(int tip, double length, double angle) {
  SPREKK_EXPECT(is_index(tip, count()), tip);
  if (is_laid_[tip] || !is_new(tip)) return;
  tips_[tip].first_length = length;
  tips_[tip].first_angle = angle;
}

/// Increments, of a tip whose speed is not known: to where its load falls to the toughness, by the slope that is known.
double Front::first_advance(int i, const FrontState& state) const {
  const double slope = slopes_.jacobian(2 * i, 2 * i), least = is_warm_ ? least_warm_advance : least_first_advance;
  return slope < 0 ? std::clamp(excess(state) / -slope, least, first_part) : first_part;
}

/// The first trial of a tip: a new segment is that which the fine level has found; others go on with their speed.
void Front::begin(int i, const FrontState& state) {
  grows_[i] = is_laid_[i] = 1;
  FrontTip& tip = tips_[i];
  if (is_new(i)) {
    SPREKK_EXPECT(tip.first_length > 0, i);
    length_[i] = tip.first_length;
    angle_[i] = tip.first_angle;
    return;
  }
  const double expected = tip.speed > 0 ? tip.speed * dt_ : first_advance(i, state) * options_.increment;
  length_[i] = std::min(tip.longest, tip.covered + std::min(expected, options_.increment));
  angle_[i] = tip.ahead + std::clamp(tip.turning * (length_[i] - tip.covered), -largest_turn, largest_turn);
}

void Front::learn(const std::vector<FrontState>& states) {
  SPREKK_EXPECT(verdict_ == Verdict::again);
  SPREKK_EXPECT(static_cast<int>(states.size()) == count(), states.size(), count());
  ++trials_;
  const Eigen::VectorXd found = residual(states);
  if (trials_ < options_.most_trials && shorten_closed(states)) return;
  if (is_other_mesh_) leave_mesh(found);
  update_jacobian(found);
  last_ = states;
  const FrontEquations front = equations(found);
  const Eigen::VectorXd counted = count_loads(found, front);
  worst_ = worst_shear_ = 0;
  bool is_met = has_equal_advances(found) &&
                front.difference.lpNorm<Eigen::Infinity>() <= of_differences * options_.load_tolerance;
  for (int i = 0; i < count(); ++i) {
    if (!grows_[i]) {
      if (may_start(i) && load_at_rest(i, found) > options_.load_tolerance) is_met = false;
      continue;
    }
    const double load = counted[2 * i];
    const bool is_shortest = is_new(i) && length_[i] <= shortest(i) * (1 + at_limit) && tells_of_length(i, found);
    if (is_shortest && (options_.holds_state ? excess(states[i]) < -options_.load_tolerance : load < 0))
      continue;  // at rest, whatever its direction
    const double off = is_held(2 * i, found) ? 0 : std::abs(load),
                 shear = is_held(2 * i + 1, found) ? 0 : std::abs(found[2 * i + 1]);
    worst_ = std::max(worst_, off);
    worst_shear_ = std::max(worst_shear_, shear);
    if (off > options_.load_tolerance || shear > options_.direction_tolerance) is_met = false;
  }
  if (is_met) {
    verdict_ = Verdict::found;
    return;
  }
  if (is_met_but_for_noise(found)) {
    verdict_ = Verdict::found;
    is_rough_ = true;
    return;
  }
  const Eigen::VectorXd from = return_to_best(found);
  if (trials_ >= options_.most_trials || trials_ - last_gain_ >= patience) {
    verdict_ = Verdict::failed;
    reason_ = "the advance of the tips was not found";
    return;
  }
  step(from);
}

void Front::learn_of_others(const std::vector<FrontState>& states) {
  SPREKK_EXPECT(verdict_ == Verdict::found);
  SPREKK_EXPECT(static_cast<int>(states.size()) == count(), states.size(), count());
  const std::vector<FrontState> before = last_;
  last_ = states;
  const Eigen::VectorXd found = residual(states);
  for (int i = 0; i < count(); ++i) {
    if (before[i].is_evaluated || !may_start(i) || load_at_rest(i, found) <= options_.load_tolerance) continue;
    verdict_ = Verdict::again;
    is_rough_ = false;
    return step(found);
  }
}

/// With the state held the load falls from that at the start, and the length is bracketed between one that is too short
/// and one that is too long.
void Front::learn_length(int tip, double excess) {
  Bracket& known = brackets_[tip];
  const Length here{length_[tip], excess};
  std::optional<Length>& third = known.third;
  if (excess > 0) {
    if (known.longer) third = known.shorter;
    known.shorter = here;
  } else {
    if (known.longer) third = known.longer;
    known.longer = here;
  }
  // A narrow bracket: its ends were found in different directions, and one of them no longer holds.
  if (!known.longer || known.longer->length - known.shorter.length >= closed_bracket * known.longer->length) return;
  third.reset();
  if (excess > 0)
    known.longer.reset();
  else
    known.shorter = {0, Front::excess(start_[tip])};
}

/// m; the secant from the start or, as in Brent's method, inverse quadratic interpolation through three lengths.
double Front::length_between(int tip) const {
  const auto& [shorter, longer, third, left, right] = brackets_[tip];
  if (!longer) {
    const double fall = excess(start_[tip]) - shorter.excess;
    return fall > 0 ? std::min(tips_[tip].longest, shorter.length * (1 + shorter.excess / fall)) : tips_[tip].longest;
  }
  const double a = shorter.excess, b = longer->excess, width = longer->length - shorter.length;
  double next = shorter.length + width * a / (a - b);
  if (third && third->excess != a && third->excess != b) {
    const double c = third->excess;
    const double through_three = shorter.length * b * c / ((a - b) * (a - c)) +
                                 longer->length * a * c / ((b - a) * (b - c)) +
                                 third->length * a * b / ((c - a) * (c - b));
    if (through_three > shorter.length && through_three < longer->length) next = through_three;
  }
  return std::clamp(next, shorter.length + margin * width, longer->length - margin * width);
}

/// Turns to the estimate for another length. The error of the estimate is taken to be in proportion to the length.
void Front::turn_with_length(int tip, double length) {
  if (tips_[tip].has_angle || length == length_[tip]) return;
  forget_angles(tip);
  const auto estimate = [&](double l) { return local_symmetry_angle(start_[tip].sifs, l, tips_[tip].largest_turn); };
  const double turn = angle_[tip] - tips_[tip].angle;
  angle_[tip] =
      tips_[tip].angle + std::clamp(estimate(length) + (turn - estimate(length_[tip])) * length / length_[tip],
                                    -tips_[tip].largest_turn, tips_[tip].largest_turn);
}

void Front::forget_angles(int tip) {
  brackets_[tip].left = {tips_[tip].angle - tips_[tip].largest_turn, 0};
  brackets_[tip].right = {tips_[tip].angle + tips_[tip].largest_turn, 0};
}

/// With a given length K_II grows with the angle, also where walls close and Newton's step means nothing. So the angle
/// is bracketed. Returns false where no angle is left.
bool Front::turn_between(int tip, double tried) {
  const Sifs& sifs = last_[tip].sifs;
  Turn &left = brackets_[tip].left, &right = brackets_[tip].right;
  (sifs.k2 < 0 ? left : right) = {tried, sifs.k2};
  if (left.angle >= right.angle) return false;
  const bool is_between = angle_[tip] > left.angle && angle_[tip] < right.angle, has_ends = left.k2 < 0 && right.k2 > 0;
  if (is_between && (sifs.k1 > 0 || !has_ends)) return true;
  const double part = has_ends ? left.k2 / (left.k2 - right.k2) : 0.5;
  angle_[tip] = tried + std::clamp(left.angle + part * (right.angle - left.angle) - tried, -largest_turn, largest_turn);
  return true;
}

/// The estimate of the direction is exact for short kinks.
void Front::shorten(int tip, double part, double excess) {
  brackets_[tip].longer = Length{length_[tip], excess};
  length_[tip] = std::max(shortest(tip), part * length_[tip]);
  angle_[tip] = tips_[tip].angle + local_symmetry_angle(start_[tip].sifs, length_[tip], tips_[tip].largest_turn);
  forget_angles(tip);
  before_place_.resize(0);
  best_.reset();
}

bool Front::may_shorten(int tip) const {
  return is_new(tip) && !tips_[tip].has_length && !tips_[tip].has_angle &&
         length_[tip] > shortest(tip) * (1 + at_limit);
}

/// A long kink in a wrong direction is nearly closed, and does not tell the right one. Shortens such kinks, and returns
/// whether there was one.
bool Front::shorten_closed(const std::vector<FrontState>& states) {
  bool is_shorter = false;
  for (int i = 0; i < count(); ++i) {
    const Sifs& sifs = states[i].sifs;
    if (!grows_[i] || !may_shorten(i) || std::abs(std::atan2(sifs.k2, sifs.k1)) < closed) continue;
    const double before = excess(start_[i]), here = excess({{}, sifs.k1 / tips_[i].toughness});
    const double part = here < 0 ? std::clamp(before / (before - here), shortest_part, longest_part) : longest_part;
    shorten(i, part, std::min(here, -options_.load_tolerance));
    is_shorter = true;
  }
  return is_shorter;
}

/// Trials on the last mesh are not repeated on this one: none is the best. Their difference from this one tells a slope
/// where it is large beside the error of a mesh.
void Front::leave_mesh(const Eigen::VectorXd& residual) {
  is_other_mesh_ = false;
  best_.reset();
  last_gain_ = trials_;
  part_ = 1;
  if (before_place_.size() > 0 && (residual - before_residual_).lpNorm<Eigen::Infinity>() < of_meshes)
    before_place_.resize(0);
}

/// The largest of what has to vanish, of the tips that grow.
double Front::norm(const Eigen::VectorXd& residual) const {
  const FrontEquations front = equations(residual);
  const Eigen::VectorXd counted = count_loads(residual, front);
  const std::vector<int> held = held_unknowns(residual);
  double norm = of_difference_ * front.difference.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < count(); ++i)
    for (const int unknown : {2 * i, 2 * i + 1})
      if (grows_[i] && std::ranges::find(held, unknown) == held.end())
        norm = std::max(norm, (unknown % 2 == 0 ? 1 : of_direction) * std::abs(counted[unknown]));
  return norm;
}

/// Whether trials come no nearer to the front since factors have small steps, or a state is not known better.
bool Front::is_met_but_for_noise(const Eigen::VectorXd& residual) const {
  if (!best_ || trials_ - last_gain_ < patience_with_noise) return false;
  for (int i = 0; i < count(); ++i)
    if (may_start(i) && load_at_rest(i, residual) > noise) return false;
  const double now = norm(residual);
  return now <= noise && now >= gain * best_->norm && now <= much_worse * best_->norm;
}

/// After a trial that is much worse than the best one, a warm start is dropped, or else the next
/// step is shorter.
Eigen::VectorXd Front::return_to_best(const Eigen::VectorXd& residual) {
  const double now = norm(residual);
  const std::vector<int> held = held_unknowns(residual);
  if (best_ && best_->held != held) best_.reset();                          // another norm
  if (!best_ || now <= much_worse * best_->norm || options_.holds_state) {  // lengths are kept between two others
    if (!best_ || now < gain * best_->norm) last_gain_ = trials_;
    if (!best_ || now < best_->norm) best_ = Best{place(), residual, now, held};
    part_ = 1;
    return residual;
  }
  if (is_warm_) {
    forget();
    before_place_ = best_->place;
    before_residual_ = best_->residual;
    update_jacobian(residual);
  } else {
    part_ *= shorter;
  }
  for (int i = 0; i < count(); ++i) {
    length_[i] = best_->place[2 * i] * options_.increment;
    angle_[i] = best_->place[2 * i + 1];
  }
  return best_->residual;
}

}  // namespace sprekk::fine_fracture
