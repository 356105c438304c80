// Capabilities of contact laws.
#pragma once

#include "framework/field/field.hpp"

namespace sprekk {

/// "I determine the contact traction from the displacement jump."
class FractureContact {
 public:
  static constexpr const char* promise = "determines contact tractions from displacement jumps";
  virtual ~FractureContact() = default;
  /// f of Eqs. 2–4 of the paper, Pa, (normal, tangential) of each fracture cell; normal negative in contact.
  virtual Field& traction() = 0;
  /// Input, m, (normal, tangential) of each fracture cell (Eq. 1 of the paper); opening positive.
  virtual Field& jump() = 0;
  /// How stiffly the rock answers a jump of one cell, Pa/m, (normal, tangential) of each fracture cell: a scale for the
  /// method of solution, which the answer does not depend on.
  virtual void set_wall_stiffness(const Vector& stiffness) = 0;
};

}  // namespace sprekk
