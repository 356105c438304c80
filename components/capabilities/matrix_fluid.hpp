// Capabilities of the flow in the matrix.
#pragma once

#include <optional>
#include <string>

#include "framework/assembly/linear_expression.hpp"
#include "framework/assembly/property.hpp"
#include "framework/assembly/step_time.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// What is outside of a side of the rock that fluid may pass.
struct OutsideOfRock {
  double pressure;                                   ///< Pa
  std::optional<double> conductance = std::nullopt;  ///< m/(Pa s) per area of the side; none: it does not resist
  bool only_out = false;                             ///< nothing enters
};

/// Capability: determines the pressure of the matrix from a balance of fluid volume.
class MatrixFluid {
 public:
  static constexpr const char* promise = "determines the pressure of the matrix";
  virtual ~MatrixFluid() = default;
  /// The pressure of each cell, Pa. Its equation is the volume of fluid that the cell stores during the step, less the
  /// volume that entered (m^2, in space m^3).
  virtual Field& pressure() = 0;
  /// The initial pressure of each cell, Pa: the pressure of the reference state.
  virtual const Vector& initial_pressure() const = 0;
  /// Pa, the largest of the initial pressures and of those that are prescribed during a step.
  virtual double largest_given_pressure() const = 0;
  /// The porosity of each cell, if a coupler is to add the compressibility of the grains, (alpha − phi)/K (below Eq. 7
  /// of the paper), to the storage; nullptr if the scene gives the storage as a whole, or the porosity by a formula.
  virtual const Property* porosity_for_storage() const = 0;
  /// Whether the porosity is a formula of the state. It then has all changes of the volume of the pores: no other part
  /// may add what a change of the rock's volume, or the compressibility of its grains, stores.
  virtual bool has_pores_by_formula() const { return false; }
  /// Whether that formula names this variable of the state.
  virtual bool porosity_depends_on(const std::string& /*variable*/) const { return false; }
  /// Replaces the viscosity of the scene, Pa s, one a cell. To be called by Part::evaluate_data, in every step.
  virtual void change_viscosity(const Vector& viscosity) = 0;
  /// The diffusivity of the fluid in a cell whose volume does not change, along the direction that conducts best,
  /// m^2/s; infinite without storage.
  virtual double diffusivity(int cell) const = 0;
  /// Tells what the volume of the rock stores beside the fluid's own storage where it follows the pressure, 1/Pa, one a
  /// cell: a scale for how fast pressures diffuse. To be called by Part::evaluate_data.
  virtual void accept_rock_storage(const Vector& /*storage*/) {}
  /// Whether there is a flow in a cell. Where there is none, the pressure stays the initial one, and no part may add
  /// anything to the row of the cell.
  virtual bool is_in_cell(int /*cell*/) const { return true; }
  /// Whether fluid passes a side of the outer boundary, since its pressure or what is behind it is prescribed; an index
  /// into Mesh::side_names.
  virtual bool is_open(int /*side*/) const { return false; }
  /// What is outside of an open side at a place in a step; nullopt for other sides.
  virtual std::optional<OutsideOfRock> outside(int /*side*/, const Place&, const StepTime&) const { return {}; }
};

/// Capability: accepts a flux through the walls of fractures, and gives the pressure there.
class MatrixWalls {
 public:
  static constexpr const char* promise =
      "accepts a fluid flux through the walls of fractures and gives the pressure there";
  virtual ~MatrixWalls() = default;
  /// Input: lambda of Eq. 9 of the paper for each wall, m/s, the flux from the fracture into the matrix.
  virtual Field& wall_flux() = 0;
  /// Whether fluid can flow in the matrix.
  virtual bool is_permeable() const = 0;
  /// Whether there is a flow behind a wall. Where there is none, nothing may pass through the wall.
  virtual bool is_behind_wall(int /*wall*/) const { return true; }
  /// tr p, the pressure at each wall, Pa.
  virtual const LinearExpression& wall_pressure() const = 0;
};

}  // namespace sprekk
