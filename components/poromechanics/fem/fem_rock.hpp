// Quasi-static deformation of the rock by finite elements.
#pragma once

#include <vector>

#include "components/poromechanics/fem/fem_operators.hpp"
#include "components/poromechanics/fem/given_loads.hpp"
#include "components/poromechanics/loaded_rock.hpp"
#include "framework/assembly/assemble_all.hpp"
#include "framework/assembly/needs_direct_solver.hpp"

namespace sprekk::poromechanics {

/// The parameters of finite elements: those of any rock, and the order.
struct FemOptions : Options {
  std::string order = dimension == 2 ? "second" : "first";
  Spec spec();
};

/// Unknown: the displacement of every node and, at second order, how much more the middle of every face, and in space
/// of every edge, is displaced than by the functions of lower order (CellPoint); p is one value a cell. Each row
/// balances the work of the stresses in the displacement of one function with that of the loads (N/m, in space N), or
/// holds a prescribed displacement. At first order, where rock is nearly incompressible, part of the stress against a
/// change of volume is an unknown of every cell.
///
/// At second order Young's modulus may be a formula of the state. Then the momentum rows are made anew before an
/// assembly with them, and Newton's method gets their derivatives by all that the formula names.
class FemRock : public LoadedRock, public NeedsDirectSolver, public FollowsState {
 public:
  /// Throws InputError as LoadedRock does.
  FemRock(const ComponentContext& context, const FemOptions& options);

  void evaluate_data(const StepTime& step) override;
  Need needs_direct_solver() const override;
  void begin_step(const StepTime& step) override;
  void follow_state(const Assembly& assembly) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  /// Throws InputError at first order, where the stabilization is no stress of cells.
  void require_countable() const override;
  void note_step(Notes& notes, const StepTime& step) const override;
  std::map<std::string, long> counts() const override { return {{"stress discretizations", discretizations_}}; }

  const LinearExpression& volume_change() const override { return volume_.value; }
  double largest_load() const override { return given_.largest_stress; }
  const LinearExpression& displacement_jump() const override { return jump_.value; }
  Vector wall_compliance() override { return operators_.wall_compliance; }
  std::string flaw_of_jumps() const override;
  Vector outer_displacement() const override;

  /// All coefficients of the displacement (RawDisplacement), m; on every process. To be called after begin_step.
  Vector coefficients() const;
  Vector mean_stress() const override;

 private:
  /// A quantity, and what it is as a linear function of fields. Terms of pressures are the last ones.
  struct Quantity {
    LinearInFem operators;
    LinearExpression value;
  };
  RawDisplacement raw() const { return {mesh_, &edges_}; }
  /// The unknown fields, in the order of their rows in FemOperators.
  std::vector<Field*> unknowns() const;
  void discretize();
  void use_loads();
  void use_given();
  /// With a Young's modulus by a formula: makes the momentum rows at the present state.
  void use_young();
  void assemble_young(Assembly& assembly) const;  ///< the derivatives of these rows by the variables of the formula
  SparseMatrix owned_rows(SparseMatrix rows, const Field& field) const;
  std::vector<Stiffness> present_stiffness() const;
  void count_from_equilibrium() override;
  /// A quantity of the rows that `owned` flags: of a linear function of all coefficients, or as it is.
  Quantity quantity_of(const SparseMatrix& of_all, const std::vector<char>& owned) const;
  Quantity quantity_of(LinearInFem operators, const std::vector<char>& owned) const;
  std::vector<Quantity*> quantities();

  ElementOrder order_;
  CellEdges edges_;              ///< in space: those with functions
  Field* of_edges_ = nullptr;    ///< where there are some
  Field* of_faces_ = nullptr;    ///< at second order
  Field* volumetric_ = nullptr;  ///< at first order, in nearly incompressible rock: see VolumetricSplit
  Held held_;
  std::uint64_t used_alpha_ = 0;
  Springs springs_;
  FemOperators operators_;
  GivenLoads given_;
  std::vector<Quantity> momentum_;  ///< of each unknown field
  Quantity volume_, jump_;
  LinearExpression volume_of_all_;  ///< with a formula: as volume_, but with the rows of all cells, and no constant
};

}  // namespace sprekk::poromechanics
