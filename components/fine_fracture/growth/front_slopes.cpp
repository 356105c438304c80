// The residual of a search for a front, and what the search knows of its derivative.
#include <algorithm>
#include <cmath>

#include "components/fine_fracture/growth/front.hpp"
#include "components/fine_fracture/growth/front_limits.hpp"
#include "components/fine_fracture/growth/kink.hpp"
#include "components/fine_fracture/growth/turn_slope.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double shared_slope = -0.2;  ///< of ln K_eq by one increment of another tip, as long as none is known

double shear(const FrontState& state) { return std::atan2(state.sifs.k2, state.sifs.k1); }

}  // namespace

double Front::excess(const FrontState& state) {
  if (state.excess) return *state.excess;
  constexpr double least = 1e-3;  // for the logarithm of a load that is zero
  return std::log(std::max(least, state.load));
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

/// m, of what counts as the length of the fracture when the tip advances. A new segment that turns from the direction
/// ahead is a kink, whose K falls with its own length. 0: not known.
double Front::size_of(int tip) const {
  const bool is_kink = is_new(tip) && std::abs(angle_[tip] - tips_[tip].ahead) > least_kink;
  return tips_[tip].size > 0 && is_kink ? length_[tip] : tips_[tip].size;
}

/// An angle changes K by moving the tip sideways, in proportion to the length of its segment, and K_II by the
/// direction, as at a kink. The effect of an advance falls with a power of the length that the fracture has already.
void Front::scale(Eigen::MatrixXd& jacobian, const std::vector<FrontState>& states, bool inverse) const {
  for (int j = 0; j < count(); ++j) {
    if (const double size = size_of(j); size > 0)
      jacobian.col(2 * j) *= std::pow(size / options_.increment, inverse ? by_size : -by_size);
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
  scale(slopes, last_, true);
  // A tip at rest does not turn, so its slopes by the angle are unknown.
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

/// Drops the slopes from earlier trials and searches.
void Front::forget() {
  make_jacobian();
  for (int i = 0; i < count(); ++i)
    if (grows_[i] && last_[i].is_evaluated) set_turn_slope(i, last_[i].sifs);
  is_warm_ = false;
  slopes_.forget_moves();
}

}  // namespace sprekk::fine_fracture
