// Capabilities of heat in the matrix and in the fractures.
#pragma once

#include "components/capabilities/carried.hpp"
#include "framework/field/units_of_amounts.hpp"

namespace sprekk {

/// Heat: temperatures in K, amounts in J/m (in space J). A capacity is a heat capacity in J/(m K) (in space J/K).
inline const Carried carried_heat = {"heat",
                                     "matrix_heat",
                                     "temperature",
                                     "K",
                                     "W/m^2",
                                     energy_unit,
                                     "conductivity",
                                     "heat capacity",
                                     dimension == 2 ? "J/(m K)" : "J/K",
                                     "300 K",
                                     "give '{}.heat_capacity' and 'fluid_heat_capacity' of one porosity, storage and "
                                     "compressibility",
                                     "T",
                                     {},
                                     std::nullopt,
                                     true};

/// Capability: determines the temperature of the matrix from a balance of heat.
class MatrixTemperature : public virtual MatrixCarried {
 public:
  static constexpr const char* promise = "determines the temperature of the matrix";
  Field& temperature() { return value(); }
  /// The temperature of the reference state, without thermal stress.
  const Vector& initial_temperature() const { return initial_value(); }
};

/// Capability: accepts a flux of heat through the walls of fractures, and gives the temperature there.
class HeatWalls : public virtual CarriedWalls {
 public:
  static constexpr const char* promise = "accepts a flux of heat through the walls of fractures";
};

/// Capability: determines the temperature in the fractures from a balance of heat.
class FractureTemperature : public virtual FractureCarried {
 public:
  static constexpr const char* promise = "determines the temperature in the fractures";
  Field& temperature() { return value(); }
};

}  // namespace sprekk
