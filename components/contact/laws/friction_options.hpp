// What a scene says of the law of friction.
#pragma once

#include <memory>
#include <string>

#include "components/contact/laws/no_input.hpp"
#include "framework/config/spec.hpp"
#include "framework/scene/law_registry.hpp"

namespace sprekk::contact {

class FrictionLaw;

/// Parameters of the law of friction.
struct FrictionOptions {
  std::string type = "constant";
  LawChoice<FrictionLaw, NoInput> registered;
  Spec spec();
  /// Null for the constant one.
  std::unique_ptr<FrictionLaw> build() const;
};

}  // namespace sprekk::contact
