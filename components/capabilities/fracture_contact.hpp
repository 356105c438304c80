// Capabilities of contact laws.
#pragma once

#include "framework/field/field.hpp"

namespace sprekk {

/// Capability: determines the contact traction from the displacement jump.
class FractureContact {
 public:
  static constexpr const char* promise = "determines contact tractions from displacement jumps";
  virtual ~FractureContact() = default;
  /// The contact traction f of Eqs. 2–4 of the paper, Pa, (normal, tangential) of each fracture cell; the normal
  /// component is negative in contact.
  virtual Field& traction() = 0;
  /// Input: the displacement jump, m, (normal, tangential) of each fracture cell (Eq. 1 of the paper); opening
  /// positive.
  virtual Field& jump() = 0;
  /// The stiffness of the rock against a jump of one cell, Pa/m, (normal, tangential) of each fracture cell. It scales
  /// the method of solution; the solution does not depend on it.
  virtual void set_wall_stiffness(const Vector& stiffness) = 0;
};

}  // namespace sprekk
