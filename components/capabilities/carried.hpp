// Capabilities of what fluid carries, and what is conducted as well: heat, or a dissolved tracer.
#pragma once

#include <cctype>
#include <optional>
#include <string>
#include <vector>

#include "framework/assembly/linear_expression.hpp"
#include "framework/config/range.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// What is carried: its words and units. A cell holds its value times a capacity.
struct Carried {
  std::string quantity;       ///< of the balance: "heat"
  std::string matrix_type;    ///< of components in the matrix, without the discretization: "matrix_heat"
  std::string value;          ///< the unknown: "temperature"
  std::string unit;           ///< of the value
  std::string flux_unit;      ///< of what is conducted per area
  std::string amount_unit;    ///< of what a cell holds
  std::string conductivity;   ///< what conducts it: "conductivity"
  std::string capacity;       ///< what holds it: "heat capacity"
  std::string capacity_unit;  ///< amount_unit over unit
  std::string example;        ///< of a value, as a scene writes it
  std::string advice;         ///< what to give where more fluid leaves a cell than it has; {} is the component
  const char* in_formulas;    ///< the name of the value in formulas of the flow; nullptr where they may not use it
  Range range;                ///< of values
  /// The value of fluid from outside for which the scene gives none; without it, such fluid has the value of the cell
  /// that it enters.
  std::optional<double> of_unknown_fluid;
  bool has_absolute_zero;  ///< whether values near zero are a mistake (cold.hpp)
};

inline std::string capitalized(std::string word) {
  word[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
  return word;
}

/// Capability: determines a carried value in the matrix from a balance.
class MatrixCarried {
 public:
  virtual ~MatrixCarried() = default;
  virtual const Carried& carried() const = 0;
  /// One a cell. Its equation is the amount that the cell stores during the step, less what entered.
  virtual Field& value() = 0;
  /// What each cell holds per unit of the value (Carried::capacity_unit), without the fluid that has entered or left it
  /// since the start; empty where the value is given and nothing is stored.
  virtual const Vector& capacity() const = 0;
  /// One a cell.
  virtual const Vector& initial_value() const = 0;
  /// The value that is prescribed at the centre of an outer face in this step.
  virtual std::optional<double> side_value(int face) const = 0;
  /// The rate of decay of what each cell holds, 1/s, one a cell; empty where nothing decays.
  virtual const Vector& decay() const = 0;
  /// Adds to what each cell conducts by itself, until the next call. In Part::evaluate_data, or between two solves.
  virtual void add_conductivity(std::vector<Tensor> added) = 0;
};

/// Capability: accepts what is conducted through the walls of fractures, and gives the value there.
class CarriedWalls {
 public:
  virtual ~CarriedWalls() = default;
  /// Input: what is conducted through each wall, from the fracture into the matrix, per area (Carried::flux_unit).
  virtual Field& wall_flux() = 0;
  /// The value at each wall.
  virtual const LinearExpression& wall_value() const = 0;
};

/// Capability: determines a carried value in the fractures from a balance.
class FractureCarried {
 public:
  virtual ~FractureCarried() = default;
  virtual const Carried& carried() const = 0;
  /// One a fracture cell. Its equation is the amount that the cell stores during the step, less what entered.
  virtual Field& value() = 0;
  /// As in MatrixCarried.
  virtual const Vector& capacity() const = 0;
  /// The value that is prescribed in this step where a fracture ends on a side, at a ridge.
  virtual std::optional<double> end_value(int ridge) const = 0;
  /// The conductance between the middle of the fracture and each wall, per area: Carried::flux_unit over the unit of
  /// the value, one a wall.
  virtual const Vector& wall_conductance() const = 0;
  /// The thickness of what stores and conducts at the start, m, one a fracture cell; nullptr where there is none.
  virtual const Vector* thickness() const { return nullptr; }
  /// As in MatrixCarried.
  virtual const Vector& decay() const = 0;
  /// Adds to conductivity times aperture of each fracture cell, until the next call; as in MatrixCarried.
  virtual void add_conductivity(std::vector<Tensor> added) = 0;
};

}  // namespace sprekk
