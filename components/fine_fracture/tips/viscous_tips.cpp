// Tips that the viscosity of their fluid holds back.
#include <algorithm>

#include "components/fine_fracture/growth/viscous_tip.hpp"
#include "components/fine_fracture/tips/ends.hpp"
#include "components/fine_fracture/tips/tips.hpp"

namespace sprekk::fine_fracture {

double Tips::apparent_toughness(const Tip& tip, double speed) const {
  return apparent_toughness(tip, speed, toughness(tip));
}

double Tips::apparent_toughness(const Tip& tip, double speed, double at_rest) const {
  const double viscosity = surroundings_->fluid_viscosity(tip.end.fracture, tip.end.at_end);
  const LameParameters lame = surroundings_->stiffness(position(tip, {}));
  const ViscousTip moving{at_rest, Elasticity{lame.lambda, lame.shear}.plane_modulus(), viscosity};
  const double full = moving.apparent_toughness(last_cell(tip.end).measure, speed);
  // Where the fluid lags behind the tip, there is no fluid near the tip, so only the toughness counts.
  return at_rest * (1 + surroundings_->filled_part(tip.end.fracture, tip.end.at_end) * (full - 1));
}

double Tips::resistance(const Tip& tip, const TipPath& path) const {
  const double at_rest = toughness(tip, path);
  if (!grows_within_steps_ || is_held_ || !is_viscous(tip)) return at_rest;
  // A repeated search of this step begins where the accepted state ends, and so does the advance.
  const double advance = length_of(position(tip, {}), path) - length_of(position(tip, {}), tip.accepted.path);
  return apparent_toughness(tip, std::max(0.0, advance) / step_.dt, at_rest);
}

bool Tips::is_viscous(const Tip& tip) const {
  return surroundings_->fluid_viscosity(tip.end.fracture, tip.end.at_end) > 0;
}

}  // namespace sprekk::fine_fracture
