// FrictionalContact's friction at one place: a trial traction is returned to the cone |f_t| <= bound.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace sprekk::contact {

/// The state of a place on the walls: closed and sticking, closed and slipping, or open.
enum class State { stick, slip, open };

/// The Euclidean length of a tangential vector; in two dimensions the absolute value of its one component.
template <int n>
double magnitude(const Eigen::Matrix<double, n, 1>& vector) {
  if constexpr (n == 1)
    return std::abs(vector[0]);
  else
    return vector.norm();
}

/// The unit vector of a vector; for zero one of the unit vectors.
template <int n>
Eigen::Matrix<double, n, 1> direction_of(const Eigen::Matrix<double, n, 1>& vector) {
  using Direction = Eigen::Matrix<double, n, 1>;
  if constexpr (n == 1) {
    return Direction(vector[0] > 0 ? 1.0 : -1.0);
  } else {
    const double length = vector.norm();
    return length > 0 ? Direction(vector / length) : Direction(Direction::UnitX());
  }
}

/// A trial traction, Pa, with n tangential components: f + c times the gap and the slip of the step (Alart and Curnier
/// 1991).
template <int n>
struct TrialTraction {
  double normal;                           ///< negative in contact
  Eigen::Matrix<double, n, 1> tangential;  ///< along the tangents of the cell
  double bound;                            ///< of |f_t|: the radius of the cone of friction at the trial's normal part
  double tension = 0;                      ///< tensile strength, Pa
  bool holds_open = false;                 ///< whether open walls still hold `bound` along them: cohesion

  bool is_open() const { return normal > tension; }
  bool sticks() const { return magnitude<n>(tangential) <= bound; }
  State state() const { return is_open() ? State::open : sticks() ? State::stick : State::slip; }
};

/// The tangential traction to which a trial is returned, Pa, and its derivatives.
template <int n>
struct ReturnedTraction {
  Eigen::Matrix<double, n, 1> tangential = Eigen::Matrix<double, n, 1>::Zero();
  Eigen::Matrix<double, n, n> by_trial = Eigen::Matrix<double, n, n>::Zero();  ///< d tangential / d trial tangential
  Eigen::Matrix<double, n, 1> by_bound = Eigen::Matrix<double, n, 1>::Zero();  ///< d tangential / d bound
};

/// The projection of the trial onto the disk |f_t| <= bound: itself where it sticks, `bound` along its direction where
/// it slips, and zero where the walls are open without cohesion (Eq. 3 of the paper with f_t of any number of
/// components). Where it slips, a turn of the trial by an angle turns the traction by the same angle: the derivative
/// is bound / |trial| (I − d d^T), which is zero in a plane.
template <int n>
ReturnedTraction<n> return_to_cone(const TrialTraction<n>& trial) {
  ReturnedTraction<n> returned;
  if (trial.is_open() && !trial.holds_open) return returned;
  if (trial.sticks()) {
    returned.tangential = trial.tangential;
    returned.by_trial.setIdentity();
    return returned;
  }
  const Eigen::Matrix<double, n, 1> direction = direction_of<n>(trial.tangential);
  returned.tangential = direction * trial.bound;
  returned.by_bound = direction;
  if constexpr (n > 1) {
    const double length = trial.tangential.norm();
    if (length > 0) {
      returned.by_trial.setIdentity();
      returned.by_trial -= direction * direction.transpose();
      returned.by_trial *= trial.bound / length;
    }
  }
  return returned;
}

}  // namespace sprekk::contact
