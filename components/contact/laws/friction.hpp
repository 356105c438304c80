// The coefficient of friction as a function of the state of the walls.
#pragma once

#include "components/contact/laws/no_input.hpp"
#include "components/contact/laws/wall_state.hpp"
#include "framework/scene/law_registry.hpp"

namespace sprekk::contact {

/// The coefficient of friction.
class FrictionLaw {
 public:
  virtual ~FrictionLaw() = default;
  /// The coefficient, not negative, and its derivatives by the state, which is not negative. `friction`: what the scene
  /// gives as friction for this place.
  virtual OfWalls at(double friction, const WallState& state) const = 0;
  /// Whether it changes with this variable.
  virtual bool depends_on(WallVariable variable) const = 0;
};

/// Laws beside those of `weakening` and `rate_and_state`, which plug-ins register.
using FrictionLaws = LawRegistry<FrictionLaw, NoInput>;
FrictionLaws& friction_laws();

}  // namespace sprekk::contact
