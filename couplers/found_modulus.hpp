// The stabilization fixed_stress from what the first passes of an iteration show.
#pragma once

#include <algorithm>

#include "framework/types.hpp"

namespace sprekk::couplers {

/// Rock answers a change dp of the pressure by a change of volume alpha dV = b V dp with b between alpha^2/(lambda + 2
/// G) (irrotational displacements) and alpha^2/(lambda + G) (a pressure that is the same everywhere). Two solves of the
/// rock in one step show where between: the share of the second one that makes alpha dV and L V dp do the same work on
/// dp (Rayleigh's quotient). Any L between both bounds converges, so what is found can only be quicker or slower.
class FoundModulus {
 public:
  /// Share of the second bound; half before anything is known.
  double share() const { return share_; }
  /// A step, or a stage of one, begins: changes until now are those of loads.
  void begin_step() { passes_ = 0; }
  /// The rock has been solved for with this pressure (Pa); `stored`: alpha times the volume of each cell (m^2); `least`
  /// and `most`: both bounds of b V (m^2/Pa). All on all processes.
  void rock_is_solved(const Vector& pressure, const Vector& stored, const Vector& least, const Vector& most) {
    constexpr int looked_at = 2;        // pairs of passes; later ones change little but round-off
    constexpr double round_off = 1e-6;  // of the largest pressure
    if (passes_ > 0 && passes_ <= looked_at) {
      const Vector dp = pressure - pressure_;
      const Vector squares = dp.cwiseAbs2();
      const double low = least.dot(squares), high = most.dot(squares);
      const bool is_seen = dp.lpNorm<Eigen::Infinity>() > round_off * pressure.lpNorm<Eigen::Infinity>();
      if (is_seen && high > low) share_ = std::clamp(((stored - stored_).dot(dp) - low) / (high - low), 0.0, 1.0);
    }
    ++passes_;
    pressure_ = pressure;
    stored_ = stored;
  }

  /// Steps begin with what accepted ones have shown.
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
