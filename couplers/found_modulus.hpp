// The modulus of the stabilization fixed_stress, found from the first passes of an iteration.
#pragma once

#include <algorithm>

#include "framework/round_off.hpp"
#include "framework/types.hpp"

namespace sprekk::couplers {

/// Rock responds to a change dp of the pressure by a change of volume alpha dV = b V dp, with b between alpha^2/(lambda
/// + 2 G) (irrotational displacements) and alpha^2/(lambda + G) (a pressure that is the same everywhere). Two solves of
/// the rock in one step show where b lies between these bounds: L is the value for which alpha dV and L V dp do the
/// same work on dp (a Rayleigh quotient), given as a share of the way from the first bound to the second. Passes
/// converge with any L between the bounds, so the choice changes only their number.
class FoundModulus {
 public:
  /// L as a share of the way from the first bound to the second; one half before anything is known.
  double share() const { return share_; }
  /// To be called when a step, or a stage of one, begins: the first change of the pressure in it comes from loads, and
  /// is ignored.
  void begin_step() { passes_ = 0; }
  /// The rock has been solved for with this pressure (Pa); `stored`: alpha times the volume of each cell (m^2); `least`
  /// and `most`: both bounds of b V (m^2/Pa). All processes need all values.
  void rock_is_solved(const Vector& pressure, const Vector& stored, const Vector& least, const Vector& most) {
    constexpr int looked_at = 2;  // pairs of passes; in later ones the change is little more than round-off
    if (passes_ > 0 && passes_ <= looked_at) {
      const Vector dp = pressure - pressure_;
      const Vector squares = dp.cwiseAbs2();
      const double low = least.dot(squares), high = most.dot(squares);
      const bool is_seen = dp.lpNorm<Eigen::Infinity>() > rounding::far_above * pressure.lpNorm<Eigen::Infinity>();
      if (is_seen && high > low) share_ = std::clamp(((stored - stored_).dot(dp) - low) / (high - low), 0.0, 1.0);
    }
    ++passes_;
    pressure_ = pressure;
    stored_ = stored;
  }

  /// The share at the end of the last accepted step, with which the next one begins.
  void accepted() { accepted_share_ = share_; }
  void rewound() { share_ = accepted_share_; }
  void restore(double share) { share_ = accepted_share_ = share; }

 private:
  static constexpr double middle = 0.5;  // the best for pressures of any shape
  double share_ = middle, accepted_share_ = middle;
  int passes_ = 0;
  Vector pressure_, stored_;
};

}  // namespace sprekk::couplers
