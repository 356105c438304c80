// Capabilities of heat in the matrix and in the fractures.
#pragma once

#include <optional>

#include "framework/assembly/linear_expression.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// Capability: determines the temperature of the matrix from a balance of heat.
class MatrixTemperature {
 public:
  static constexpr const char* promise = "determines the temperature of the matrix";
  virtual ~MatrixTemperature() = default;
  /// K, one a cell. Its equation is the heat that the cell stores during the step, less what entered (J/m, in space J).
  virtual Field& temperature() = 0;
  /// The heat that each cell stores per kelvin, J/(m K) (in space J/K), by its own heat capacity and without the fluid
  /// that has entered or left it; empty where the temperature is given and no heat is stored.
  virtual const Vector& heat_capacity() const = 0;
  /// K, one a cell: the temperature of the reference state, without thermal stress.
  virtual const Vector& initial_temperature() const = 0;
  /// The temperature that is prescribed at the centre of an outer face in this step, K.
  virtual std::optional<double> side_temperature(int face) const = 0;
};

/// Capability: accepts a flux of heat through the walls of fractures, and gives the temperature there.
class HeatWalls {
 public:
  static constexpr const char* promise = "accepts a flux of heat through the walls of fractures";
  virtual ~HeatWalls() = default;
  /// Input: the conducted heat flux through each wall, from the fracture into the matrix, W/m^2.
  virtual Field& wall_heat_flux() = 0;
  /// The temperature at each wall, K.
  virtual const LinearExpression& wall_temperature() const = 0;
};

/// Capability: determines the temperature in the fractures from a balance of heat.
class FractureTemperature {
 public:
  static constexpr const char* promise = "determines the temperature in the fractures";
  virtual ~FractureTemperature() = default;
  /// K, one a fracture cell. Its equation is the heat that the cell stores during the step, less what entered (J/m, in
  /// space J).
  virtual Field& temperature() = 0;
  /// The heat that each fracture cell stores per kelvin, J/(m K) (in space J/K), as in MatrixTemperature.
  virtual const Vector& heat_capacity() const = 0;
  /// The temperature that is prescribed in this step where a fracture ends on a side, at a ridge, K.
  virtual std::optional<double> end_temperature(int point) const = 0;
  /// By how much heat is conducted between the middle of the fracture and each of its walls, W/(m^2 K).
  virtual const Vector& wall_conductance() const = 0;
  /// The thickness of what stores and conducts heat at the start, m, one a fracture cell; nullptr where there is none.
  virtual const Vector* thickness() const { return nullptr; }
};

}  // namespace sprekk
