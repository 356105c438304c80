// How friction follows from what walls have done and bear.
#pragma once

#include "components/contact/laws/no_input.hpp"
#include "components/contact/laws/wall_state.hpp"
#include "framework/scene/law_registry.hpp"

namespace sprekk::contact {

/// The coefficient of friction.
class FrictionLaw {
 public:
  virtual ~FrictionLaw() = default;
  /// The coefficient, not negative, and its derivatives by the state, where a scene gives `friction` for this place.
  /// The state never is below zero.
  virtual OfWalls at(double friction, const WallState& state) const = 0;
  /// Whether it changes with this variable.
  virtual bool depends_on(WallVariable variable) const = 0;
};

/// Laws beside those of `weakening` and `rate_and_state`, which plug-ins register.
using FrictionLaws = LawRegistry<FrictionLaw, NoInput>;
FrictionLaws& friction_laws();

}  // namespace sprekk::contact
