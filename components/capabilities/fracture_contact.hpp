// Capabilities of contact laws.
#pragma once

#include <optional>

#include "framework/field/field.hpp"

namespace sprekk {

/// The law of walls that slide, about their present state, for places within their cell:
///   f_t = -direction friction f_n,  [u]_n = opening + dilation [u]_t  where they touch,  f = 0 and a larger [u]_n
///   where they do not.
struct SlidingWalls {
  double friction;
  double direction;  ///< 1 or -1, of f_t
  double dilation;   ///< with the sign of [u]_t
  double opening;    ///< m
};

/// Capability: determines the contact traction from the displacement jump.
class FractureContact {
 public:
  static constexpr const char* promise = "determines contact tractions from displacement jumps";
  virtual ~FractureContact() = default;
  /// The contact traction f of Eqs. 2–4 of the paper, Pa, (normal, tangential) of each fracture cell; the normal
  /// component is negative in contact.
  virtual Field& traction() = 0;
  /// Whether the contact is on a fracture cell. Where it is not, its traction and its jump are zero: another contact
  /// may be there, and sums over all contacts are those of all fractures.
  virtual bool is_on_fracture_cell(int /*cell*/) const { return true; }
  /// Input: the displacement jump, m, (normal, tangential) of each fracture cell (Eq. 1 of the paper); opening
  /// positive.
  virtual Field& jump() = 0;
  /// The stiffness of the rock against a jump of one cell, Pa/m, (normal, tangential) of each fracture cell. It scales
  /// Newton's method, which does not change the solution (and the springs of a penalty method, which do), and tells
  /// sliding() which slip and tractions are small.
  virtual void set_wall_stiffness(const Vector& stiffness) = 0;
  /// Whether the law depends on the shear modulus of the rock. If it does, rock without one is refused.
  virtual bool needs_shear_modulus() const { return false; }
  /// The shear modulus of the rock beside each fracture cell, Pa. Called before each step where it is known.
  virtual void set_shear_modulus(const Vector& /*modulus*/) {}
  /// The opening of a cell whose walls touch under a normal traction (Pa) and have not slid, m: negative where they
  /// close under pressure.
  virtual double opening_under(int /*cell*/, double /*normal_traction*/) const { return 0; }
  /// The law of a cell whose walls slide or are open, or have slid and rest; nothing while they stick.
  virtual std::optional<SlidingWalls> sliding(int cell) const = 0;
};

}  // namespace sprekk
