// The closure of walls in contact under pressure.
#pragma once

#include "components/contact/laws/no_input.hpp"
#include "framework/scene/law_registry.hpp"

namespace sprekk::contact {

/// The closure of walls in contact, m, from zero pressure on.
class Closure {
 public:
  virtual ~Closure() = default;
  /// The closure, m, and its derivative by the pressure between the walls, m/Pa.
  struct Value {
    double closure, by_pressure;
  };
  /// The closure under the normal pressure −f_n of the contact, Pa. Below zero the function is continued linearly.
  virtual Value at(double pressure) const = 0;
};

/// Further laws, which plug-ins register.
using ClosureLaws = LawRegistry<Closure, NoInput>;
ClosureLaws& closure_laws();

}  // namespace sprekk::contact
