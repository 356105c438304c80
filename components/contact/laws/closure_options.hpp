// What a scene says of the closure.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "components/contact/laws/no_input.hpp"
#include "framework/config/spec.hpp"
#include "framework/scene/law_registry.hpp"

namespace sprekk::contact {

class Closure;

/// Parameters of the closure.
struct ClosureOptions {
  std::string law = "hard";
  double stiffness = 0;         ///< Pa/m, at zero pressure
  double largest = 0;           ///< m
  std::optional<Data> formula;  ///< m, of the closure
  LawChoice<Closure, NoInput> registered;
  Spec spec();
  /// Null for hard walls, and for a formula.
  std::unique_ptr<Closure> build() const;
};

}  // namespace sprekk::contact
