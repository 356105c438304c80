// Quasi-static deformation of the rock (Eqs. 5 and 7 of the paper), for any discretization of the stress.
#pragma once

#include <vector>

#include "components/capabilities/poroelastic_rock.hpp"
#include "components/capabilities/rock_state.hpp"
#include "components/capabilities/rock_stress.hpp"
#include "components/poromechanics/options.hpp"
#include "components/poromechanics/pore_load.hpp"
#include "components/poromechanics/rock_stiffness.hpp"
#include "components/poromechanics/settled_rock.hpp"
#include "components/poromechanics/stress_discretization.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/counts_work.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/notes_start.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::poromechanics {

/// Unknown: the displacement u of every cell, from the reference state with the initial stress and pressure:
///   sigma = sigma_0 + C : grad u − sum of alpha (p − p_0) I,
/// with C and alpha at the end of the step: earlier values have no effect. An initial stress that is not in equilibrium
/// loads the rock: u is counted from the state before equilibrium.
/// Each pair of rows balances the forces on one cell (N/m): −(sum of the forces on its faces) − body force = 0.
class Rock : public Component,
             public KeepsState,
             public FollowsMesh,
             public CountsWork,
             public PoroelasticRock,
             public RockWalls,
             public RockState,
             public RockStress,
             public CountsFromHere,
             public NotesStart {
 public:
  /// Throws InputError for sides that do not exist, for a stiffness that is not positive definite, and when the
  /// displacements that are prescribed let the rock move as a rigid body.
  Rock(const ComponentContext& context, const Options& options, const StressDiscretization& discretization);

  void evaluate_data(const StepTime& step) override;
  bool allows_stages() const override { return true; }
  void begin_step(const StepTime& step) override;
  /// Discretizes on the new mesh; the unchanged part of the discretization of `before` is kept.
  void carry_over(const Part& before, const MeshChange& change) override;
  void settled(const MeshChange& change) override;
  void count_from_here(const SettledFields& settled) override;
  bool has_settled_reference() const override { return settled_ || has_settled_loads(loads_); }
  void save(std::map<std::string, Vector>& state) const override;
  void restore(const std::map<std::string, Vector>& state) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void output(std::vector<OutputField>& fields) const override;
  void note_input(Notes& notes) const override;
  void note_start(Notes& notes) const override;
  void note_step(Notes& notes, const StepTime& step) const override;
  std::vector<double> switch_times() const override;
  std::map<std::string, long> counts() const override {
    return {{"stress discretizations", discretizations_},
            {"stress discretizations: cells", discretized_cells_},
            {"stress discretizations: regions", discretized_regions_}};
  }

  void accept_pore_pressure(const Field& pressure, const Vector& alpha, const Vector& reference) override;
  double largest_load() const override;
  const LinearExpression& volume_change() const override { return volume_change_; }
  void change_alpha(const Field& pressure, const Vector& alpha) override;
  const Property& bulk_modulus() const override { return stiffness_.bulk_modulus(); }
  Field& wall_traction() override { return *wall_traction_; }
  const LinearExpression& displacement_jump() const override { return jump_; }
  void count_jumps_from(const Vector& jumps) override;

  const Field& displacement() const override { return displacement_; }
  Vector outer_displacement() const override;
  Vector pore_stress() const override;
  Vector pore_stress_by(const Field& pressure) const override;
  SymmetricTensor initial_stress(int cell, const Point& x) const override;
  bool initial_stress_changes() const override { return !stiffness_.excavation().is_empty(); }
  bool has_body_force() const override { return options_.has_body_force(); }
  Point body_force(int cell, const Point& x) const override;
  std::optional<LameParameters> stiffness(int cell) const override { return stiffness_.lame(cell); }
  std::uint64_t properties_version() const override;

  Vector mean_stress() const override;

  /// The total force on every face, sigma·n integrated, n out of face_cells[f][0] (N/m, x and y); for tests and output.
  Vector face_forces() const;

 protected:
  const Mesh& mesh() const { return mesh_; }
  const std::vector<Stiffness>& stiffness_of_cells() const { return stiffness_.of_cells(); }

 private:
  struct Load : PoreLoad {
    Operator force_on_cell;  ///< momentum rows of p
    std::uint64_t alpha_version = 1, used_version = 0;
  };

  bool is_discretized() const;  ///< on this mesh, with this stiffness
  void discretize();
  /// Discretizes, and keeps the unchanged part of the operators that were made for `before`.
  void discretize_from(const StressInputs& before, const StressOperators& operators, const MeshChange& change);
  void find_conditions();
  /// Updates the matrices of momentum rows and walls after the operators have changed.
  void use_operators();
  void use_loads();
  void count_from_equilibrium();
  void map_walls();
  void apply_boundary();
  /// Tractions, and what is left on the walls beside them, Pa, (normal, tangential) of each fracture cell.
  Vector wall_load() const { return wall_traction_->now() + wall_remainder_->now(); }
  /// Pa, of the initial stress of the cell on a side (0 or 1) of a face, on the normal of the face; where rock is taken
  /// away, the part that still acts.
  Point initial_traction(int face, int side) const;
  /// The load on a face from different initial stresses of the two regions at it, N/m; zero if they are in equilibrium.
  Point initial_load(int face) const;
  bool may_have_initial_load(int face) const;
  /// Lets pore pressures load the rock that is still there.
  void use_excavation();
  /// The mean stress of each cell from forces on all faces, and their moments about the centres of the faces, Pa.
  Vector stress_of(const Vector& forces, const Vector& moments) const;

  const Mesh& mesh_;
  Options options_;
  StressDiscretization stress_discretization_;
  Origin origin_;
  Field& displacement_;
  Field* wall_traction_ = nullptr;   ///< exists with fractures only
  Field* wall_remainder_ = nullptr;  ///< exists with fractures only
  RockStiffness stiffness_;
  std::optional<SettledRock> settled_;  ///< the state from which displacements are counted, if it was settled
  Vector jumps_;                        ///< m, of walls while u = 0; empty where they are zero
  std::uint64_t used_excavation_ = 0;
  std::vector<Load> loads_;

  std::vector<Stiffness> stiffness_of_operators_;  ///< of the operators; only if properties change, in one process
  std::uint64_t discretized_mesh_ = 0, discretized_stiffness_ = 0;
  StepTime evaluated_for_;
  bool data_evaluated_ = false, boundary_applied_ = false;
  long discretizations_ = 0, discretized_cells_ = 0, discretized_regions_ = 0;
  std::vector<FaceConditions> conditions_;
  StressOperators operators_;
  SparseMatrix wall_forces_;        ///< 2 faces × 2 fracture cells: boundary values that wall tractions make
  SparseMatrix wall_jump_;          ///< 2 fracture cells × 2 faces: the jump of face displacements, in (n, t)
  Operator force_of_displacement_;  ///< momentum rows
  Operator force_of_wall_traction_;
  Vector carried_traction_;  ///< Pa, of the state that is being settled on other cells; otherwise empty
  Vector boundary_values_;   ///< see StressOperators
  Vector initial_forces_;    ///< of the initial stress on every face, N/m
  Vector body_forces_;       ///< on every cell, N/m
  Vector force_constant_;
  LinearExpression volume_change_, jump_;
};

}  // namespace sprekk::poromechanics
