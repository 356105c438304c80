// Quasi-static deformation of the rock (Eqs. 5 and 7), for any discretization of the stress.
#pragma once

#include <vector>

#include "components/capabilities/poroelastic_rock.hpp"
#include "components/poromechanics/mpsa/mpsa.hpp"
#include "components/poromechanics/options.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::poromechanics {

/// Unknown: the displacement u of every cell, from the reference state with the initial stress and pressure:
///   sigma = sigma_0 + C : grad u − sum of alpha (p − p_0) I.
/// Each pair of rows balances the forces on one cell (N/m): −(sum of the forces on its faces) − body force = 0.
class Rock : public Component, public PoroelasticRock, public RockWalls {
 public:
  Rock(const ComponentContext& context, const Options& options);

  void begin_step(const StepTime& step) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void output(std::vector<OutputField>& fields) const override;
  std::vector<double> switch_times() const override;
  std::map<std::string, long> counts() const override { return {{"stress discretizations", discretizations_}}; }

  void accept_pore_pressure(const Field& pressure, const Vector& alpha, const Vector& reference) override;
  const LinearExpression& volume_change() const override { return volume_change_; }
  const Vector& bulk_modulus() const override { return bulk_modulus_; }
  Field& wall_traction() override { return *wall_traction_; }
  const LinearExpression& displacement_jump() const override { return jump_; }

  /// The total force on every face, sigma·n integrated, n out of face_cells[f][0] (N/m, x and y); for tests and output.
  Vector face_forces() const;

 private:
  struct Load {
    const Field* pressure;
    Vector alpha, reference;
    SparseMatrix force_on_cell;  ///< momentum rows of p
  };

  void check_sides() const;
  std::vector<Stiffness> stiffness();
  void discretize();
  void map_walls();
  void evaluate_boundary(double time);
  Point initial_traction(int face, const Point& normal) const;

  const Mesh& mesh_;
  Options options_;
  Field& displacement_;
  Field* wall_traction_ = nullptr;  ///< exists with fractures only
  Vector bulk_modulus_;
  std::vector<Load> loads_;

  std::uint64_t discretized_version_ = 0;
  double boundary_time_ = 0;
  bool boundary_evaluated_ = false;
  long discretizations_ = 0;
  StressOperators operators_;
  SparseMatrix wall_forces_;            ///< 2 faces × 2 fracture cells: boundary values that wall tractions make
  SparseMatrix wall_jump_;              ///< 2 fracture cells × 2 faces: the jump of face displacements, in (n, t)
  SparseMatrix force_of_displacement_;  ///< momentum rows
  SparseMatrix force_of_wall_traction_;
  Vector boundary_values_;  ///< see StressOperators
  Vector force_constant_;
  LinearExpression volume_change_, jump_;
};

}  // namespace sprekk::poromechanics
