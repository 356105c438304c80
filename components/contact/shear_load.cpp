#include "components/contact/shear_load.hpp"

#include <algorithm>

namespace sprekk::contact {

ShearLoad shear_load(const Point& traction, const Strength& strength, bool has_parted) {
  const double shear = traction.tail<dimension - 1>().norm(), pressed = std::max(0.0, -traction[0]);
  const double held = strength.cohesion + strength.friction * pressed;
  if (has_parted) return {strength.friction, 1};
  return {pressed > 0 ? shear / pressed : 0, held > 0 ? shear / held : 0};
}

}  // namespace sprekk::contact
