// Formulas of the state in laws of the contact.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "components/contact/laws/friction.hpp"
#include "framework/assembly/state_fields.hpp"

namespace sprekk::contact {

const StateVariables& strength_variables();  ///< of friction and cohesion, as WallState has them
const StateVariables& dilation_variables();  ///< the slip
const StateVariables& closure_variables();   ///< the pressure

/// What a scene says of laws that may be formulas.
struct LawData {
  const Data &friction, &cohesion;
  const std::optional<Data>&dilation, &closure;
};

/// The laws of a contact that are formulas or come from plug-ins, or data that numbers and built-in laws do not cover.
class Formulas {
 public:
  /// `friction_law`: null where friction is a number, a formula, or that of a built-in law.
  /// `history`: what formulas may name beside their variables, nullptr for nothing.
  Formulas(const LawData& laws, std::unique_ptr<FrictionLaw> friction_law, const std::vector<Place>& places,
           const History* history);
  void set_time(const StepTime& step);

  const StateFormula* friction() const { return pointer(friction_); }
  const FrictionLaw* friction_law() const { return friction_law_.get(); }
  const StateFormula* cohesion() const { return pointer(cohesion_); }
  const StateFormula* dilation() const { return pointer(dilation_); }
  const StateFormula* closure() const { return pointer(closure_); }
  /// Whether the strength changes with this variable.
  bool strength_names(WallVariable variable) const;
  /// Whether walls may lose strength while they slip.
  bool may_weaken() const {
    return strength_names(slip_of_walls) || strength_names(path_of_walls) || strength_names(slip_rate_of_walls);
  }

 private:
  static const StateFormula* pointer(const std::optional<StateFormula>& formula) {
    return formula ? &*formula : nullptr;
  }
  std::optional<StateFormula> friction_, cohesion_, dilation_, closure_;
  std::unique_ptr<FrictionLaw> friction_law_;
};

}  // namespace sprekk::contact
