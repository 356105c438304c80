// Capabilities of the flow in the matrix.
#pragma once

#include "framework/assembly/linear_expression.hpp"
#include "framework/assembly/property.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// "I determine the pressure of the matrix from a balance of fluid volume."
class MatrixFluid {
 public:
  static constexpr const char* promise = "determines the pressure of the matrix";
  virtual ~MatrixFluid() = default;
  /// Pa, one a cell. Its equation is the volume of fluid that each cell stores during the step, less what entered it
  /// (m^2).
  virtual Field& pressure() = 0;
  /// The pressure (Pa) of the reference state, one a cell: the initial one.
  virtual const Vector& initial_pressure() const = 0;
  /// Pa, the largest of the initial pressures and of those that are prescribed during a step.
  virtual double largest_given_pressure() const = 0;
  /// The porosity, one a cell, if the storage is to be completed by the compressibility of the grains, (alpha − phi)/K
  /// (below Eq. 7 of the paper); nullptr if the storage was given as a whole.
  virtual const Property* porosity_for_storage() const = 0;
};

/// "I accept a flux through the walls of fractures, and give the pressure there."
class MatrixWalls {
 public:
  static constexpr const char* promise =
      "accepts a fluid flux through the walls of fractures and gives the pressure there";
  virtual ~MatrixWalls() = default;
  /// Input, m/s, one a wall: lambda of Eq. 9 of the paper, the flux from the fracture into the matrix.
  virtual Field& wall_flux() = 0;
  /// Whether fluid can flow in the matrix.
  virtual bool lets_fluid_through() const = 0;
  /// tr p, Pa, one a wall.
  virtual const LinearExpression& wall_pressure() const = 0;
};

}  // namespace sprekk
