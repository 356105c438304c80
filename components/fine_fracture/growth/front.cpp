#include "components/fine_fracture/growth/front.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "components/fine_fracture/growth/kink.hpp"
#include "components/fine_fracture/growth/linear_front.hpp"
#include "components/fine_fracture/growth/most_equal_front.hpp"
#include "components/fine_fracture/growth/turn_slope.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double first_slope = -0.3;          ///< of ln K_eq over one increment, as long as none is known
constexpr double shared_slope = -0.2;         ///< the same by the growth of another tip
constexpr double least_first_advance = 0.05;  ///< of an increment: a shorter one gives no slope from two meshes
constexpr double first_part = 0.25;           ///< of an increment: the first trial of a tip without a known speed
constexpr double gain = 0.5;                  ///< of the norm of the best trial: what counts as progress
constexpr int patience = 8;                   ///< trials without progress
constexpr double much_worse = 2;              ///< of the norm of a trial over the best so far
constexpr double shorter = 0.5;               ///< steps after a trial that was much worse
constexpr double of_direction = 0.1;          ///< the weight of K_II/K_I beside ln K_eq/K_IC in that norm
constexpr double of_difference = 30;  ///< that of differences of advances: slopes of loads, 0.3, over those of H, 0.01
constexpr double largest_turn = 0.3;  ///< rad, between two trials
constexpr double quarter_turn = 1.5;  ///< rad: for a move that turns further the slope of K_II is wrong
constexpr double largest_factor = 3;  ///< between lengths of a new segment in two trials
constexpr double largest_advance = 0.6;  ///< of an increment, between two trials
constexpr double at_limit = 1e-9;        ///< of a length that is at its limit, but for rounding
constexpr double equal_advances = 1e-9;  ///< of an increment: differences below this are round-off
constexpr double of_differences = 0.1;   ///< the tolerance of differences of advances over that of loads
constexpr double alike = 0.01;  ///< of ln K over one increment: if growth of another tip unloads a tip as its own does,
                                ///< but for this, both are the same
constexpr double no_motion = 1e-300;  ///< no division by zero

double excess(const FrontState& state) {
  if (state.excess) return *state.excess;
  constexpr double least = 1e-3;
  return std::log(std::max(least, state.load));
}

double shear(const FrontState& state) { return std::atan2(state.sifs.k2, state.sifs.k1); }

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
  for (int i = 0; i < count(); ++i)
    if (tips_[i].goes_on || tips_[i].first_length > 0 || (without_growth[i].is_evaluated && without_growth[i].load > 1))
      begin(i, without_growth[i]);
  if (!any_grows()) verdict_ = Verdict::found;
  if (slopes.rows() == 2 * count()) {
    is_warm_ = true;
    slopes_.jacobian = slopes;
    scale_turns(slopes_.jacobian, without_growth, false);
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
    const double expected = tip.speed > 0 ? tip.speed * dt_ : first_part * options_.increment;
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

double Front::turn_slope_of(int tip, const Sifs& sifs, double length) const {
  return turn_slope(sifs, tips_[tip].toughness, length, tips_[tip].is_bent);
}

void Front::set_turn_slope(int i, const Sifs& sifs) {
  slopes_.jacobian(2 * i + 1, 2 * i + 1) = turn_slope_of(i, sifs, length_[i]);
}

void Front::make_jacobian() {
  slopes_.jacobian = Eigen::MatrixXd::Zero(2 * count(), 2 * count());
  for (int i = 0; i < count(); ++i) {
    for (int j = 0; j < count(); ++j)
      slopes_.jacobian(2 * i, 2 * j) = i == j ? first_slope + shared_slope : shared_slope;
    slopes_.jacobian(2 * i + 1, 2 * i + 1) = short_kink_turn_slope;
  }
}

/// An angle changes K by moving the tip sideways, in proportion to the length of its segment, and K_II by the
/// direction, as at a kink.
void Front::scale_turns(Eigen::MatrixXd& jacobian, const std::vector<FrontState>& states, bool inverse) const {
  for (int j = 0; j < count(); ++j) {
    if (!(length_[j] > 0)) continue;
    const double across = length_[j] / options_.increment,
                 turn = grows_[j] ? turn_slope_of(j, states[j].sifs, length_[j]) : short_kink_turn_slope;
    for (int i = 0; i < count(); ++i) {
      jacobian(2 * i, 2 * j + 1) *= inverse ? 1 / across : across;
      jacobian(2 * i + 1, 2 * j + 1) *= inverse ? 1 / turn : turn;
    }
  }
}

Eigen::MatrixXd Front::slopes() const {
  Eigen::MatrixXd slopes = slopes_.jacobian;
  scale_turns(slopes, last_, true);
  // Nothing is known of the turns of a tip that rests.
  for (int i = 0; i < count(); ++i)
    if (!grows_[i]) {
      slopes.col(2 * i + 1).setZero();
      slopes(2 * i + 1, 2 * i + 1) = 1;
    }
  return slopes;
}

Eigen::VectorXd Front::residual(const std::vector<FrontState>& states) const {
  Eigen::VectorXd values(2 * count());
  for (int i = 0; i < count(); ++i) {
    values[2 * i] = excess(states[i]);
    values[2 * i + 1] = 0;
    if (!states[i].is_evaluated || !grows_[i]) continue;
    const Sifs& k = states[i].sifs;
    values[2 * i + 1] = shear(states[i]);
    if (!states[i].excess && k.k1 > std::abs(k.k2))
      values[2 * i] += std::log(std::hypot(k.k1, k.k2) / equivalent_sif(k));
  }
  return values;
}

Eigen::VectorXd Front::place() const {
  Eigen::VectorXd values(2 * count());
  for (int i = 0; i < count(); ++i) {
    values[2 * i] = length_[i] / options_.increment;
    values[2 * i + 1] = angle_[i];
  }
  return values;
}

void Front::update_jacobian(const Eigen::VectorXd& residual) {
  if (before_place_.size() == 0)
    slopes_.forget_moves();
  else
    slopes_.update(place() - before_place_, residual - before_residual_);
}

void Front::learn(const std::vector<FrontState>& states) {
  SPREKK_EXPECT(verdict_ == Verdict::again);
  SPREKK_EXPECT(static_cast<int>(states.size()) == count(), states.size(), count());
  ++trials_;
  const Eigen::VectorXd found = residual(states);
  update_jacobian(found);
  last_ = states;
  const FrontEquations front = equations(found);
  const Eigen::VectorXd counted = count_loads(found, front);
  worst_ = 0;
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
    if (std::abs(load) > options_.load_tolerance || std::abs(found[2 * i + 1]) > options_.direction_tolerance)
      is_met = false;
  }
  if (is_met) {
    verdict_ = Verdict::found;
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

/// Drops the slopes from earlier trials and searches.
void Front::forget() {
  make_jacobian();
  for (int i = 0; i < count(); ++i)
    if (grows_[i] && last_[i].is_evaluated) set_turn_slope(i, last_[i].sifs);
  is_warm_ = false;
  slopes_.forget_moves();
}

/// After a trial that is much worse than the best one, a warm start is dropped, or else the next
/// step is shorter.
Eigen::VectorXd Front::return_to_best(const Eigen::VectorXd& residual) {
  const FrontEquations front = equations(residual);
  const Eigen::VectorXd counted = count_loads(residual, front);
  double norm = of_difference * front.difference.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < count(); ++i)
    if (grows_[i]) norm = std::max({norm, std::abs(counted[2 * i]), of_direction * std::abs(residual[2 * i + 1])});
  if (!best_ || norm <= much_worse * best_->norm) {
    if (!best_ || norm < gain * best_->norm) last_gain_ = trials_;
    if (!best_ || norm < best_->norm) best_ = Best{place(), residual, norm};
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

/// Tips whose loads and advances are found in common. One with a new segment is found by itself.
std::vector<int> Front::front_tips() const {
  std::vector<int> tips;
  for (int i = 0; i < count(); ++i)
    if (grows_[i] && !is_new(i) && last_[i].is_evaluated) tips.push_back(i);
  return tips;
}

double Front::advance(int tip) const { return (length_[tip] - tips_[tip].covered) / options_.increment; }

Eigen::VectorXd Front::advances(const std::vector<int>& tips) const {
  Eigen::VectorXd values(tips.size());
  for (std::size_t k = 0; k < tips.size(); ++k) values[static_cast<Eigen::Index>(k)] = advance(tips[k]);
  return values;
}

Eigen::VectorXd Front::loads(const std::vector<int>& tips, const Eigen::VectorXd& residual) {
  Eigen::VectorXd values(tips.size());
  for (std::size_t k = 0; k < tips.size(); ++k) values[static_cast<Eigen::Index>(k)] = residual[2 * tips[k]];
  return values;
}

FrontEquations Front::equations(const Eigen::VectorXd& residual) const {
  const std::vector<int> tips = front_tips();
  return most_equal_front(loads(tips, residual), advances(tips), options_.mesh_error);
}

Eigen::VectorXd Front::count_loads(const Eigen::VectorXd& residual, const FrontEquations& front) const {
  Eigen::VectorXd values = residual;
  Eigen::Index k = 0;
  for (const int tip : front_tips()) values[2 * tip] = front.residual[k++];
  return values;
}

bool Front::has_equal_advances(const Eigen::VectorXd& residual) const {
  const std::vector<int> tips = front_tips();
  if (options_.mesh_error == 0 || tips.size() < 2) return true;
  const Eigen::VectorXd advance = advances(tips);
  return !advances_are_equal(loads(tips, residual), options_.mesh_error) ||
         advance.maxCoeff() - advance.minCoeff() <= equal_advances;
}

/// What has to be positive for a tip at rest to grow.
double Front::load_at_rest(int tip, const Eigen::VectorXd& residual) const {
  const double load = residual[2 * tip];
  if (is_new(tip) || options_.mesh_error == 0) return load;
  const std::vector<int> growing = front_tips();
  if (!growing.empty())
    return load_beside_front(load, loads(growing, residual), advances(growing), options_.mesh_error);
  std::vector<int> resting;
  for (int i = 0; i < count(); ++i)
    if (may_start(i) && !is_new(i)) resting.push_back(i);
  const Eigen::VectorXd all = loads(resting, residual);
  if (load < all.maxCoeff() - 2 * options_.mesh_error) return load;
  return load_of_front_at_rest(all, options_.mesh_error);
}

/// Lets tips at rest grow that have to. True if one of them did not grow in the last trial: then a trial with the new
/// set comes before anything is concluded.
bool Front::free_tips(const Eigen::VectorXd& residual) {
  std::vector<int> freed;
  for (int i = 0; i < count(); ++i)
    if (may_start(i) && load_at_rest(i, residual) > options_.load_tolerance) freed.push_back(i);
  for (const int i : freed) {
    best_.reset();
    const bool was_laid = is_laid_[i], is_loaded = residual[2 * i] > options_.load_tolerance;
    if (!was_laid) {
      before_place_.resize(0);
      begin(i, last_[i]);
      set_turn_slope(i, last_[i].sifs);
    }
    if (!is_loaded) begin_beside_front(i);
    grows_[i] = 1;
    if (!was_laid && is_loaded) return true;
  }
  return false;
}

/// A tip that is below its toughness, but within the error of the mesh, begins without an advance. If growth of another
/// tip unloads both alike, its own growth does so, too.
void Front::begin_beside_front(int tip) {
  length_[tip] = tips_[tip].covered;
  angle_[tip] = tips_[tip].angle;
  grows_[tip] = 0;
  const std::vector<int> growing = front_tips();
  if (growing.empty()) return;
  const int leader = *std::ranges::max_element(growing, {}, [&](int i) { return advance(i); });
  const double own = slopes_.jacobian(2 * leader, 2 * leader), shared = slopes_.jacobian(2 * tip, 2 * leader);
  if (std::abs(own - shared) < alike) slopes_.jacobian.col(2 * tip) = slopes_.jacobian.col(2 * leader);
}

/// The step with Broyden's matrix. Loads and directions are linear, while the equations of the front are solved as they
/// are; these are linearized, too, if there is no solution.
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
  if (!matrix.fullPivLu().isInvertible()) {
    // Loads that were once found not to depend on lengths would leave the tips where they are.
    forget();
    matrix = matrix_of_front();
  }
  return matrix.fullPivLu().solve(-count_loads(residual, front)(free));
}

/// Whether a tip would turn further than any turn for which the slopes of K_II hold.
bool Front::turns_far(const Eigen::VectorXd& move) {
  for (Eigen::Index a = 1; a < move.size(); a += 2)
    if (std::abs(move[a]) > quarter_turn) return true;
  return false;
}

/// The step of lengths with the directions of these tips as they are.
Eigen::VectorXd Front::step_with_held_turns(const std::vector<int>& free, const Eigen::VectorXd& residual,
                                            const Eigen::VectorXd& full) {
  const Eigen::MatrixXd learnt = slopes_.jacobian;
  Eigen::VectorXd held = residual;
  for (std::size_t a = 1; a < free.size(); a += 2) {
    if (std::abs(full[static_cast<Eigen::Index>(a)]) <= quarter_turn) continue;
    slopes_.jacobian.row(free[a]).setZero();
    slopes_.jacobian.col(free[a]).setZero();
    slopes_.jacobian(free[a], free[a]) = 1;
    held[free[a]] = 0;
  }
  Eigen::VectorXd move = newton_step(free, held);
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
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(jacobian(others, others));
  if (!factors.isInvertible()) return std::nullopt;
  const Eigen::MatrixXd follow = -factors.solve(Eigen::MatrixXd(jacobian(others, lengths)));
  const Eigen::VectorXd own = -factors.solve(Eigen::VectorXd(residual(others)));
  const Eigen::VectorXd at = advances(tips);
  const auto advances = linear_front({residual(lengths) + jacobian(lengths, others) * own,
                                      jacobian(lengths, lengths) + jacobian(lengths, others) * follow, at},
                                     options_.mesh_error);
  if (!advances) return std::nullopt;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(residual.size());
  all(lengths) = *advances - at;
  all(others) = own + follow * (*advances - at);
  return Eigen::VectorXd(all(free));
}

/// Newton's step. A tip that would move back to where it was at the start of the step rests there.
void Front::step(const Eigen::VectorXd& residual) {
  if (free_tips(residual)) return;
  const Eigen::VectorXd from = place();
  std::vector<int> free;
  for (int i = 0; i < count(); ++i)
    if (grows_[i]) free.insert(free.end(), {2 * i, 2 * i + 1});
  const int size = static_cast<int>(free.size());
  const Eigen::VectorXd full = newton_step(free, residual);
  Eigen::VectorXd move = turns_far(full) ? step_with_held_turns(free, residual, full) : full;
  const Eigen::VectorXd counted = count_loads(residual, equations(residual));
  double part = part_;
  for (int a = 0; a < size; a += 2) {
    const int i = free[a] / 2;
    if (!std::isfinite(move[a]) || !std::isfinite(move[a + 1]))
      move[a] = counted[free[a]] > 0 ? 0.5 : -0.5, move[a + 1] = 0;
    part = std::min(part, largest_advance / std::max(no_motion, std::abs(move[a])));
    part = std::min(part, largest_turn / std::max(no_motion, std::abs(move[a + 1])));
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
    if (wanted <= least(i)) {
      // Back at the start of the step: the tip rests, unless it is there and above its toughness. Then its load rises
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
