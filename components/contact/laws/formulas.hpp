// Formulas of the state in laws of the contact.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "framework/assembly/state_fields.hpp"

namespace sprekk::contact {

/// What walls have done and bear: slip (m, its size), path (m, of slip and opening), slip rate (m/s), and the pressure
/// between them (Pa, not negative).
using WallState = std::array<double, 4>;
/// Their places in it.
enum WallVariable : std::size_t { slip_of_walls, path_of_walls, slip_rate_of_walls, pressure_of_walls };

const StateVariables& strength_variables();  ///< of friction and cohesion, as WallState has them
const StateVariables& dilation_variables();  ///< the slip
const StateVariables& closure_variables();   ///< the pressure

/// A value, with its derivatives by the variables.
struct OfWalls {
  double value = 0;
  WallState by{};
};

/// What a scene says of laws that may be formulas.
struct LawData {
  const Data &friction, &cohesion;
  const std::optional<Data>&dilation, &closure;
};

/// The laws of a contact that are formulas, or data that numbers and built-in laws do not cover.
class Formulas {
 public:
  Formulas(const LawData& laws, const std::vector<Place>& places);
  void set_time(double t);  ///< s

  const StateFormula* friction() const { return pointer(friction_); }
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
};

}  // namespace sprekk::contact
