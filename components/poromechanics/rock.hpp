// Quasi-static deformation of the rock (Eqs. 5 and 7 of the paper), for any discretization of the stress.
#pragma once

#include <vector>

#include "components/poromechanics/loaded_rock.hpp"
#include "components/poromechanics/pinned_cells.hpp"
#include "components/poromechanics/stress_discretization.hpp"
#include "framework/assembly/follows_mesh.hpp"

namespace sprekk::poromechanics {

/// Unknown: the displacement of every cell. An initial stress that is not in equilibrium loads the rock: the
/// displacement is counted from the state before equilibrium. Each pair of rows balances the forces on one cell (N/m):
/// −(sum of the forces on its faces) − body force = 0.
class Rock : public LoadedRock, public FollowsMesh {
 public:
  /// Throws InputError as LoadedRock does.
  Rock(const ComponentContext& context, const Options& options, const StressDiscretization& discretization);

  void evaluate_data(const StepTime& step) override;
  void begin_step(const StepTime& step) override;
  /// Discretizes on the new mesh; the unchanged part of the discretization of `before` is kept.
  void carry_over(const Part& before, const MeshChange& change) override;
  void settled(const MeshChange& change) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void note_step(Notes& notes, const StepTime& step) const override;
  std::map<std::string, long> counts() const override {
    return {{"stress discretizations", discretizations_},
            {"stress discretizations: cells", discretized_cells_},
            {"stress discretizations: regions", discretized_regions_}};
  }

  double largest_load() const override;
  const LinearExpression& volume_change() const override { return volume_change_; }
  const LinearExpression& displacement_jump() const override { return jump_; }
  std::string flaw_of_jumps() const override;
  Vector outer_displacement() const override;
  Vector mean_stress() const override;

  /// The total force on every face, sigma·n integrated, n out of face_cells[f][0] (N/m; N in space); for tests and
  /// output.
  Vector face_forces() const;

 protected:
  const Mesh& mesh() const { return mesh_; }
  const std::vector<Stiffness>& stiffness_of_cells() const { return stiffness_.of_cells(); }

 private:
  struct ForceOfLoad {
    Operator on_cell;  ///< momentum rows of p
    std::uint64_t used_version = 0;
  };

  bool is_discretized() const;  ///< on this mesh, with this stiffness
  void discretize();
  /// Discretizes, and keeps the unchanged part of the operators that were made for `before`.
  void discretize_from(const StressInputs& before, const StressOperators& operators, const MeshChange& change);
  void find_conditions();
  /// Updates the matrices of momentum rows and walls after the operators have changed.
  void use_operators();
  void use_loads();
  void count_from_equilibrium() override;
  /// Takes what a spring bears in the settled state from the prescribed force on a face.
  void subtract_settled_spring(int face);
  /// Of faces, in the directions of their conditions: prescribed ones, and those of sides on springs.
  Vector settled_displacements() const;
  void map_walls();
  void apply_boundary();
  /// Wall tractions with their remainder, Pa, normal and tangential, of each fracture cell.
  Vector wall_load() const { return wall_traction_->now() + wall_remainder_->now(); }
  /// Pa, of the initial stress of the cell on a side (0 or 1) of a face, on the normal of the face; where rock is taken
  /// away, the part that still acts.
  Point initial_traction(int face, int side) const;
  /// The load on a face from different initial stresses of the two regions at it, N/m; zero if they are in equilibrium.
  Point initial_load(int face) const;
  bool may_have_initial_load(int face) const;
  /// The mean stress of each cell from forces on all faces, and their moments about the centres of the faces, Pa.
  Vector stress_of(const Vector& forces, const Vector& moments) const;

  StressDiscretization stress_discretization_;
  PinnedCells pinned_;
  Field* wall_remainder_ = nullptr;         ///< exists with fractures only
  std::vector<ForceOfLoad> force_of_load_;  ///< of each of `loads_`, once it is discretized

  std::vector<Stiffness> stiffness_of_operators_;  ///< of the operators; only if properties change, in one process
  long discretized_cells_ = 0, discretized_regions_ = 0;
  std::vector<FaceConditions> conditions_;
  StressOperators operators_;
  SparseMatrix wall_forces_;        ///< boundary values that wall tractions make, of faces by fracture cells
  SparseMatrix wall_jump_;          ///< the jump of face displacements, along normal and tangents of fracture cells
  Operator force_of_displacement_;  ///< momentum rows
  Operator force_of_wall_traction_;
  Vector carried_traction_;      ///< Pa, of the state that is being settled on other cells; otherwise empty
  Vector boundary_values_;       ///< see StressOperators
  Vector pinned_displacements_;  ///< see PinnedCells, m
  Vector initial_forces_;        ///< of the initial stress on every face, N/m
  Vector body_forces_;           ///< on every cell, N/m
  Vector force_constant_;        ///< of the momentum rows: what does not depend on unknowns, N/m
  LinearExpression volume_change_, jump_;
};

}  // namespace sprekk::poromechanics
