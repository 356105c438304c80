// The gap of a cell, the strength of its walls, and the trial traction of the return map.
#include "components/contact/trial_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/contact/frictional_contact.hpp"
#include "components/contact/rate_and_state_walls.hpp"
#include "components/contact/tangents.hpp"
#include "framework/invariants.hpp"

namespace sprekk::contact {

namespace {
/// Of the slip that would take all shear from the walls, and of the traction that makes a slip.
constexpr double least_share = 1e-10;
}  // namespace

TangentialVector FrictionalContact::tangential(const Vector& values, int i) {
  return values.segment<tangents>(dimension * i + 1);
}

Point FrictionalContact::compliance(int i) const {
  const bool has_springs =
      multiplier_ == Multiplier::none || (multiplier_ == Multiplier::last && !is_without_shortcuts_);
  if (!has_springs) return Point::Zero();
  const Vector& rock = multiplier_ == Multiplier::last ? stiffness_of_walls_ : stiffness_of_springs_;
  return (stiffness_factor_ * rock.segment<dimension>(dimension * i)).cwiseInverse();
}

double FrictionalContact::dynamic_friction(int i) const {
  return dynamic_friction_.version() > 0 ? dynamic_friction_[i] : friction_[i];
}

double FrictionalContact::gap(int i, const Vector& traction, const Vector& jump) const {
  return jump[dimension * i] - dilated(i, magnitude<tangents>(tangential(jump, i))) +
         closure(i, traction[dimension * i]);
}

TangentialVector FrictionalContact::moved(int i) const {
  return tangential(jump_.now(), i) - tangential(jump_.accepted(), i);
}

double FrictionalContact::path(int i, double gap, double slip) const {
  const double before = std::max(0.0, this->gap(i, traction_.accepted(), jump_.accepted()));
  return path_->accepted()[i] + slip + std::max(0.0, gap - before);
}

SlipOfStep FrictionalContact::slip_of_step(int i, const TangentialVector& trial) const {
  const TangentialVector moved = this->moved(i);
  const double size = magnitude<tangents>(moved);
  if (tangents == 1 || multiplier_ == Multiplier::none) return {size, direction_of<tangents>(size > 0 ? moved : trial)};
  const TangentialVector direction = direction_of<tangents>(trial);
  const double along = moved.dot(direction);
  const bool is_first = magnitude<tangents>(tangential(jump_.accepted(), i)) <=
                        least_share * magnitude<tangents>(trial) / stiffness()[dimension * i + 1];
  return {std::max(0.0, along), direction, std::min(0.0, along), is_first};
}

void FrictionalContact::go_on_below_zero(const SlipOfStep& step, Strength& s) const {
  const double rate = dt_ > 0 ? step.below_zero / dt_ : 0, slip = step.is_first ? step.below_zero : 0;
  s.friction += step.below_zero * s.friction_by_path + slip * s.friction_by_slip + rate * s.friction_by_rate;
  s.cohesion += step.below_zero * s.cohesion_by_path + slip * s.cohesion_by_slip + rate * s.cohesion_by_rate;
  s.tension += step.below_zero * s.tension_by_path;
}

double FrictionalContact::overlap(int i) const {
  return multiplier_ == Multiplier::none ? compliance(i)[0] * traction_.now()[dimension * i] : 0.0;
}

TangentialVector FrictionalContact::elastic_slip(int i) const {
  if (multiplier_ != Multiplier::none) return TangentialVector::Zero();
  return compliance(i)[1] * (tangential(traction_.now(), i) - tangential(traction_.accepted(), i));
}

Trial FrictionalContact::trial(int i) const {
  SPREKK_EXPECT(is_index(i, mesh_.fracture_cell_count()), i, mesh_.fracture_cell_count());
  const int row = dimension * i;
  const double c_n = stiffness()[row], c_t = stiffness()[row + 1];
  SPREKK_ASSERT(c_n > 0 && c_t > 0, i, c_n, c_t);
  SPREKK_ASSERT(friction_[i] >= 0 && dilation_[i] >= 0, i, friction_[i], dilation_[i]);
  const TangentialVector u_t = tangential(jump_.now(), i);
  Trial t;
  const double slip = magnitude<tangents>(u_t);
  t.gap = gap(i, traction_.now(), jump_.now());
  t.gap_by_traction = closure_by_traction(i, traction_.now()[row]);
  t.dilation = dilation_at(i, slip);
  const TangentialVector f_t = tangential(traction_.now(), i);
  t.tangential = f_t + c_t * (moved(i) - elastic_slip(i));
  const SlipOfStep step = slip_of_step(i, t.tangential);
  t.path = path_ ? path(i, t.gap, step.size) : 0;
  t.path_by_slip.setZero();
  t.path_by_gap = 0;
  if (path_) {
    const double before = std::max(0.0, gap(i, traction_.accepted(), jump_.accepted()));
    t.path_by_gap = t.gap > before;
  }
  t.gap -= overlap(i);
  t.normal = traction_.now()[row] + c_n * t.gap;
  const double pressure = std::max(0.0, -t.normal);
  t.strength = strength(i, wall_state(i, t.path, step, pressure));
  if (step.below_zero < 0) go_on_below_zero(step, t.strength);
  t.tension = t.strength.tension;
  t.holds_open = weakening_.is_on() && t.strength.cohesion > 0;
  if (path_) t.path_by_slip = step.by_jump;
  t.bound = t.strength.cohesion - t.strength.friction * std::min(0.0, t.normal);
  // Friction that depends on the slip rate has no cone.
  if (rate_and_state_) t.bound = std::numeric_limits<double>::infinity();
  if (!kept_.empty() && kept_[i] && !t.is_open()) t.bound = std::numeric_limits<double>::infinity();
  // At the very start of slip, |slip| has the slope of the direction in which the cell is about to slip.
  t.slip_direction = direction_of<tangents>(magnitude<tangents>(u_t) > 0 ? u_t : t.tangential);
  t.bound_by_pressure =
      t.strength.friction + pressure * t.strength.friction_by_pressure + t.strength.cohesion_by_pressure;
  t.bound_by_slip = (t.strength.cohesion_by_slip + pressure * t.strength.friction_by_slip) *
                    (step.is_first ? step.by_jump : t.slip_direction);
  if (dt_ > 0)
    t.bound_by_slip += (t.strength.cohesion_by_rate + pressure * t.strength.friction_by_rate) / dt_ * step.by_jump;
  t.least_bound = least_share * c_t * magnitude<tangents>(u_t);
  if (rate_and_state_ && rate_and_state_->has_step()) t.at_rate = at_rate(i, t);
  return t;
}

Trial::AtRate FrictionalContact::at_rate(int i, const Trial& t) const {
  const double size = magnitude<tangents>(t.tangential);
  const RateAndStateLaw::Returned held =
      rate_and_state_->returned(i, friction_[i], size, std::max(0.0, -t.normal), stiffness()[dimension * i + 1]);
  const TangentialVector direction = direction_of<tangents>(t.tangential);
  Trial::AtRate at_rate;
  at_rate.slip_rate = direction * held.slip_rate;
  at_rate.by_pressure = direction * held.by_pressure;
  at_rate.traction.tangential = direction * held.traction;
  // Where the trial changes its direction, so does the traction.
  const double of_turn = size > 0 ? held.traction / size : held.by_trial;
  at_rate.traction.by_trial.setIdentity();
  at_rate.traction.by_trial -= direction * direction.transpose();
  at_rate.traction.by_trial *= of_turn;
  at_rate.traction.by_trial += direction * direction.transpose() * held.by_trial;
  return at_rate;
}

Trial FrictionalContact::trial_of_update(int i) const {
  Trial t = trial(i);
  if (back_slip_.empty() || back_slip_[i].taken != BackSlip::Piece::beyond_kink) return t;
  t.slip_direction = -t.slip_direction;
  // The linear function on the other side of the kink, at the same slip: the opening by dilation has the other sign.
  const double slip = t.slip_direction.dot(tangential(jump_.now(), i));
  t.gap = jump_.now()[dimension * i] - std::copysign(dilated(i, std::abs(slip)), slip) +
          closure(i, traction_.now()[dimension * i]) - overlap(i);
  // The walls touch, whatever the sign of the normal trial traction: the linear function passes through the values
  // beyond the kink.
  const double normal = traction_.now()[dimension * i] + stiffness()[dimension * i] * t.gap;
  t.bound = t.strength.cohesion - t.strength.friction * normal;
  t.normal = std::min(normal, 0.0);
  return t;
}

}  // namespace sprekk::contact
