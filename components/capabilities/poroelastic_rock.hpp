// Capabilities of the deformation of the matrix.
#pragma once

#include "framework/assembly/linear_expression.hpp"
#include "framework/assembly/property.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// "I accept pore pressure as a load, and give the volume change of each cell."
class PoroelasticRock {
 public:
  static constexpr const char* promise = "accepts a pore pressure as a load and gives the change of volume";
  virtual ~PoroelasticRock() = default;
  /// From now on the stress contains −alpha (p − reference) I: `pressure` one a cell (Pa), `alpha` one a cell,
  /// `reference` one a cell (Pa). To be called while the scene is built.
  virtual void accept_pore_pressure(const Field& pressure, const Vector& alpha, const Vector& reference) = 0;
  /// The alpha of a pressure that has been accepted has changed. To be called by Part::evaluate_data.
  virtual void change_alpha(const Field& pressure, const Vector& alpha) = 0;
  /// div u integrated over each cell (m^2).
  virtual const LinearExpression& volume_change() const = 0;
  /// Pa, the largest stress that is prescribed, on sides and at the start; infinite where weight or prescribed
  /// displacements load the rock as well. To be asked during a step.
  virtual double largest_load() const = 0;
  /// The drained bulk modulus (Pa), one a cell.
  virtual const Property& bulk_modulus() const = 0;
};

/// "I accept tractions on the walls of fractures, and give the jump of the displacement across them."
class RockWalls {
 public:
  static constexpr const char* promise = "accepts tractions on the walls of fractures and gives the displacement jump";
  virtual ~RockWalls() = default;
  /// Input, Pa, (normal, tangential) of each fracture cell: n·sigma on the plus wall (Eq. 4 of the paper); opposite on
  /// the minus wall.
  virtual Field& wall_traction() = 0;
  /// u(minus) − u(plus) (Eq. 1 of the paper), m, (normal, tangential) of each fracture cell.
  virtual const LinearExpression& displacement_jump() const = 0;
};

}  // namespace sprekk
