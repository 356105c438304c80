// Tips that the viscosity of their fluid holds back.
#include "components/fine_fracture/growth/viscous_tip.hpp"
#include "components/fine_fracture/tips/tips.hpp"

namespace sprekk::fine_fracture {

double Tips::apparent_toughness(const Tip& tip, double speed) const {
  const double viscosity = surroundings_->fluid_viscosity(tip.end.fracture, tip.end.at_end);
  const LameParameters lame = surroundings_->stiffness(position(tip, {}));
  const double at_rest = toughness(tip);
  const ViscousTip moving{at_rest, Elasticity{lame.lambda, lame.shear}.plane_modulus(), viscosity};
  const double full = moving.apparent_toughness(last_cell(tip.end).measure, speed);
  // Where the fluid lags behind the tip, there is no fluid near the tip, so only the toughness counts.
  return at_rest * (1 + surroundings_->filled_part(tip.end.fracture, tip.end.at_end) * (full - 1));
}

bool Tips::is_viscous(const Tip& tip) const {
  return surroundings_->fluid_viscosity(tip.end.fracture, tip.end.at_end) > 0;
}

}  // namespace sprekk::fine_fracture
