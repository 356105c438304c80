// Capabilities of the deformation of the matrix.
#pragma once

#include <string>

#include "framework/assembly/linear_expression.hpp"
#include "framework/assembly/property.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// Capability: accepts pore pressure as a load, and gives the volume change of each cell.
class PoroelasticRock {
 public:
  static constexpr const char* promise = "accepts a pore pressure as a load and gives the change of volume";
  virtual ~PoroelasticRock() = default;
  /// Adds −alpha (p − reference) I to the stress, with `pressure` and `reference` (Pa) and `alpha` of each cell. To be
  /// called while the scene is built.
  virtual void accept_pore_pressure(const Field& pressure, const Vector& alpha, const Vector& reference) = 0;
  /// Replaces the alpha of a pressure that accept_pore_pressure was called with. To be called by Part::evaluate_data.
  virtual void change_alpha(const Field& pressure, const Vector& alpha) = 0;
  /// Whether the stiffness is a formula of the state. bulk_modulus() is then that of the initial state.
  virtual bool stiffness_follows_state() const { return false; }
  /// From now on the `alpha` of this pressure is in proportion to a stiffness that follows the state: the one given is
  /// that of the initial state. To be called while the scene is built.
  virtual void let_alpha_follow_stiffness(const Field& /*pressure*/) {}
  /// div u integrated over each cell (m^2, in space m^3).
  virtual const LinearExpression& volume_change() const = 0;
  /// The largest prescribed stress, on sides and at the start, Pa; infinite where weight or prescribed displacements
  /// load the rock as well. To be called during a step.
  virtual double largest_load() const = 0;
  /// The drained bulk modulus of each cell, Pa.
  virtual const Property& bulk_modulus() const = 0;
  /// How unequally free rock expands under an equal pressure in its pores: the largest strain along an axis over the
  /// smallest one, in the cell where that is most; 1 where the rock is isotropic.
  virtual double unequal_expansion() const { return 1; }
};

/// Capability: accepts tractions on the walls of fractures, and gives the jump of the displacement across them.
class RockWalls {
 public:
  static constexpr const char* promise = "accepts tractions on the walls of fractures and gives the displacement jump";
  virtual ~RockWalls() = default;
  /// Input: the traction n·sigma on the plus wall (Eq. 4 of the paper), Pa, (normal, tangential) of each fracture cell;
  /// the minus wall has the opposite traction.
  virtual Field& wall_traction() = 0;
  /// u(minus) − u(plus) (Eq. 1 of the paper), m, (normal, tangential) of each fracture cell.
  virtual const LinearExpression& displacement_jump() const = 0;
  /// The jumps of walls while the displacement is zero, m, as displacement_jump(): none unless this is called, while
  /// the scene is built or before the first step.
  virtual void count_jumps_from(const Vector& jumps) = 0;
  /// Why the jumps of the cells at a tip have an error that does not vanish on finer meshes; empty where they converge.
  virtual std::string flaw_of_jumps() const { return {}; }
  /// By how much the traction on a fracture cell closes its jump while the unknown displacements stay, m/Pa, (normal,
  /// tangential) of each fracture cell. Where the displacements of walls are unknowns: by how much, if only those of
  /// this cell's walls moved. A scale, right on the fracture cells that the process owns.
  virtual Vector wall_compliance() {
    Vector compliance = Vector::Zero(wall_traction().size());
    for (const LinearExpression::Term& term : displacement_jump().terms)
      if (term.field == &wall_traction())
        for (int i = 0; i < compliance.size(); ++i) compliance[i] = -term.matrix.entries().coeff(i, i);
    return compliance;
  }
};

}  // namespace sprekk
