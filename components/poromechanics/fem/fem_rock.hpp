// Quasi-static deformation of the rock by finite elements.
#pragma once

#include <optional>
#include <vector>

#include "components/capabilities/poroelastic_rock.hpp"
#include "components/capabilities/rock_state.hpp"
#include "components/capabilities/rock_stress.hpp"
#include "components/poromechanics/fem/fem_operators.hpp"
#include "components/poromechanics/fem/given_loads.hpp"
#include "components/poromechanics/options.hpp"
#include "components/poromechanics/pore_load.hpp"
#include "components/poromechanics/rock_stiffness.hpp"
#include "components/poromechanics/settled_rock.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/counts_work.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/needs_direct_solver.hpp"
#include "framework/assembly/notes_start.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::poromechanics {

/// The parameters of finite elements: those of any rock, and the order.
struct FemOptions : Options {
  std::string order = "second";
  Spec spec();
};

/// Unknown: the displacement u of every node and, at second order, how much more the middle of every face is displaced
/// than the mean of its ends (CellPoint), from the reference state with the initial stress and pressure:
///   sigma = sigma_0 + C : grad u − sum of alpha (p − p_0) I,
/// with C and alpha at the end of the step and p one value a cell. Each row balances the work of these stresses in the
/// displacement of one function with that of the loads (N/m), or holds a prescribed displacement. At first order, where
/// rock is nearly incompressible, part of the stress against a change of volume is an unknown of every cell.
class FemRock : public Component,
                public KeepsState,
                public CountsWork,
                public PoroelasticRock,
                public RockWalls,
                public RockState,
                public RockStress,
                public CountsFromHere,
                public NeedsDirectSolver,
                public NotesStart {
 public:
  /// Throws InputError as Rock does.
  FemRock(const ComponentContext& context, const FemOptions& options);

  void evaluate_data(const StepTime& step) override;
  bool allows_stages() const override { return true; }
  Need needs_direct_solver() const override;
  void begin_step(const StepTime& step) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  /// Throws InputError at first order, where the stabilization is no stress of cells.
  void require_countable() const override;
  void count_from_here(const SettledFields& settled) override;
  bool has_settled_reference() const override { return settled_ || has_settled_loads(loads_); }
  void save(std::map<std::string, Vector>& state) const override;
  void restore(const std::map<std::string, Vector>& state) override;
  void output(std::vector<OutputField>& fields) const override;
  void note_input(Notes& notes) const override;
  void note_start(Notes& notes) const override;
  void note_step(Notes& notes, const StepTime& step) const override;
  std::vector<double> switch_times() const override;
  std::map<std::string, long> counts() const override { return {{"stress discretizations", discretizations_}}; }

  void accept_pore_pressure(const Field& pressure, const Vector& alpha, const Vector& reference) override;
  void change_alpha(const Field& pressure, const Vector& alpha) override;
  const LinearExpression& volume_change() const override { return volume_.value; }
  double largest_load() const override { return given_.largest_stress; }
  const Property& bulk_modulus() const override { return stiffness_.bulk_modulus(); }
  Field& wall_traction() override { return *wall_traction_; }
  const LinearExpression& displacement_jump() const override { return jump_.value; }
  void count_jumps_from(const Vector& jumps) override;
  Vector wall_compliance() override { return operators_.wall_compliance; }
  std::string flaw_of_jumps() const override;

  const Field& displacement() const override { return displacement_; }
  Vector outer_displacement() const override;
  Vector pore_stress() const override;
  Vector pore_stress_by(const Field& pressure) const override;
  SymmetricTensor initial_stress(int cell, const Point& x) const override;
  bool initial_stress_changes() const override { return !stiffness_.excavation().is_empty(); }
  bool has_body_force() const override { return options_.has_body_force(); }
  Point body_force(int cell, const Point& x) const override;
  std::optional<LameParameters> stiffness(int cell) const override { return stiffness_.lame(cell); }
  std::uint64_t properties_version() const override { return stiffness_.version() + alpha_version_; }

  /// All coefficients of the displacement (RawDisplacement), m; on every process. To be called after begin_step.
  Vector coefficients() const;
  Vector mean_stress() const override;

 private:
  /// A quantity, and what it is as a linear function of fields. Terms of pressures are the last ones.
  struct Quantity {
    LinearInFem operators;
    LinearExpression value;
  };
  /// The unknown fields, in the order of their rows in FemOperators.
  std::vector<Field*> unknowns() const;
  void discretize();
  void use_loads();
  void use_given();
  void count_from_equilibrium();
  /// A quantity of the rows that `owned` flags: of a linear function of all coefficients, or as it is.
  Quantity quantity_of(const SparseMatrix& of_all, const std::vector<char>& owned) const;
  Quantity quantity_of(LinearInFem operators, const std::vector<char>& owned) const;
  std::vector<Quantity*> quantities();
  Tensor mean_gradient(const Vector& coefficients, int cell) const;

  const Mesh& mesh_;
  FemOptions options_;
  ElementOrder order_;
  Origin origin_;
  Field& displacement_;
  Field* of_faces_ = nullptr;       ///< at second order
  Field* volumetric_ = nullptr;     ///< at first order, in nearly incompressible rock: see VolumetricSplit
  Field* wall_traction_ = nullptr;  ///< exists with fractures only
  RockStiffness stiffness_;
  Held held_;
  std::vector<PoreLoad> loads_;
  std::optional<SettledRock> settled_;  ///< the state from which displacements are counted, if it was settled
  Vector jumps_;                        ///< m, of walls while u = 0; empty where they are zero
  std::uint64_t used_excavation_ = 0;

  std::uint64_t discretized_mesh_ = 0, discretized_stiffness_ = 0, alpha_version_ = 1, used_alpha_ = 0;
  bool data_evaluated_ = false, is_given_used_ = false;  ///< given_ is in the constants of quantities
  StepTime evaluated_for_;
  long discretizations_ = 0;
  FemOperators operators_;
  GivenLoads given_;
  std::vector<Quantity> momentum_;  ///< of each unknown field
  Quantity volume_, jump_;
};

}  // namespace sprekk::poromechanics
