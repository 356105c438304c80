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
      last_(without_growth) {
  SPREKK_EXPECT(without_growth.size() == tips_.size(), without_growth.size(), tips_.size());
  SPREKK_EXPECT(options_.increment > 0 && options_.shortest > 0, options_.increment, options_.shortest);
  for (int i = 0; i < count(); ++i) {
    length_[i] = tips_[i].covered;
    angle_[i] = tips_[i].angle;
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

/// The first trial of a tip: from its speed, or else from the expansion of a short kink.
void Front::begin(int i, const FrontState& state) {
  grows_[i] = is_laid_[i] = 1;
  FrontTip& tip = tips_[i];
  const double half = 0.5 * options_.increment;
  if (tip.first_length > 0) {
    length_[i] = tip.first_length;
    angle_[i] = tip.first_angle;
    return;
  }
  if (!is_new(i)) {
    const double expected = tip.speed > 0 ? tip.speed * dt_ : first_advance(i, state) * options_.increment;
    length_[i] = std::min(tip.longest, tip.covered + std::min(expected, options_.increment));
    angle_[i] = tip.ahead + std::clamp(tip.turning * (length_[i] - tip.covered), -largest_turn, largest_turn);
    return;
  }
  const double low = options_.shortest, high = std::min(tip.longest, tip.speed > 0 ? options_.increment : half);
  length_[i] = tip.speed > 0 ? std::clamp(tip.speed * dt_, low, high)
                             : longest_overloaded_kink(state.sifs, tip.toughness, low, high);
  angle_[i] = tip.angle + local_symmetry_angle(state.sifs, length_[i]);
  const double slope = log_slope_of_kink(state.sifs, length_[i]);
  if (std::isfinite(slope)) slopes_.jacobian(2 * i, 2 * i) = std::min(slope * options_.increment, first_slope);
}

void Front::learn(const std::vector<FrontState>& states) {
  SPREKK_EXPECT(verdict_ == Verdict::again);
  SPREKK_EXPECT(static_cast<int>(states.size()) == count(), states.size(), count());
  ++trials_;
  const Eigen::VectorXd found = residual(states);
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
    const bool is_shortest = is_new(i) && length_[i] <= shortest(i) * (1 + at_limit);
    if (is_shortest && load < 0) continue;  // at rest, whatever its direction
    worst_ = std::max(worst_, std::abs(load));
    worst_shear_ = std::max(worst_shear_, std::abs(found[2 * i + 1]));
    if (std::abs(load) > options_.load_tolerance || std::abs(found[2 * i + 1]) > options_.direction_tolerance)
      is_met = false;
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
  double norm = of_difference_ * front.difference.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < count(); ++i)
    if (grows_[i]) norm = std::max({norm, std::abs(counted[2 * i]), of_direction * std::abs(residual[2 * i + 1])});
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
  if (!best_ || now <= much_worse * best_->norm) {
    if (!best_ || now < gain * best_->norm) last_gain_ = trials_;
    if (!best_ || now < best_->norm) best_ = Best{place(), residual, now};
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
