// What the rock is, and what loads it, whatever discretizes the stress.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/capabilities/formula_of_cells.hpp"
#include "components/capabilities/poroelastic_rock.hpp"
#include "components/capabilities/rock_state.hpp"
#include "components/capabilities/rock_stress.hpp"
#include "components/poromechanics/options.hpp"
#include "components/poromechanics/pore_load.hpp"
#include "components/poromechanics/rock_stiffness.hpp"
#include "components/poromechanics/settled_rock.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/counts_work.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/notes_start.hpp"
#include "framework/scene/component.hpp"

namespace sprekk {
struct MeshChange;
}

namespace sprekk::poromechanics {

/// The unknown displacement u, counted from the reference state with the initial stress and pressure or from a state
/// that was settled:
///   sigma = sigma_0 + C : grad u − sum of alpha (p − p_0) I,
/// with C and alpha at the end of the step: earlier values have no effect. Equations are those of a discretization.
/// Where Young's modulus is a formula of the state, C is that of the initial state times `ratio_`.
class LoadedRock : public Component,
                   public KeepsState,
                   public CountsWork,
                   public PoroelasticRock,
                   public RockWalls,
                   public RockState,
                   public RockStress,
                   public CountsFromHere,
                   public NotesStart,
                   public TakesState {
 public:
  ~LoadedRock() override;
  void offer_state(const std::string& variable, const StateField& source) override;
  void require_state() const override;
  bool stiffness_follows_state() const override { return young_ != nullptr; }
  void let_alpha_follow_stiffness(const Field& pressure) override;
  bool allows_stages() const override { return true; }
  void count_from_here(const SettledFields& settled) override;
  bool has_settled_reference() const override { return settled_ || has_settled_loads(loads_); }
  void save(std::map<std::string, Vector>& state) const override;
  void restore(const std::map<std::string, Vector>& state) override;
  void output(std::vector<OutputField>& fields) const override;
  void note_input(Notes& notes) const override;
  void note_start(Notes& notes) const override;
  std::vector<double> switch_times() const override;

  void accept_pore_pressure(const Field& pressure, const Vector& alpha, const Vector& reference) override;
  void change_alpha(const Field& pressure, const Vector& alpha) override;
  const Property& bulk_modulus() const override { return stiffness_.bulk_modulus(); }
  double unequal_expansion() const override { return stiffness_.unequal_expansion(); }
  Field& wall_traction() override { return *wall_traction_; }
  void count_jumps_from(const Vector& jumps) override;

  const Field& displacement() const override { return displacement_; }
  Vector pore_stress() const override;
  Vector pore_stress_by(const Field& pressure) const override;
  SymmetricTensor initial_stress(int cell, const Point& x) const override;
  bool initial_stress_changes() const override { return !stiffness_.excavation().is_empty(); }
  bool has_body_force() const override { return options_.has_body_force(); }
  Point body_force(int cell, const Point& x) const override;
  std::optional<LameParameters> stiffness(int cell) const override;
  std::uint64_t properties_version() const override { return stiffness_.version() + alpha_version(); }

 protected:
  /// `location`: where the displacement is. Throws InputError for sides that do not exist, for a stiffness that is not
  /// positive definite, and when the displacements that are prescribed let the rock move as a rigid body.
  LoadedRock(const ComponentContext& context, const Options& options, Location location);
  /// To be called by the constructor of a discretization, after its own unknowns.
  void add_wall_traction(FieldStore& fields);
  /// Takes Young's modulus of the present state. Returns whether it may have changed. Throws StateError.
  bool take_young();
  /// Evaluates stiffness and excavation for a step. False where loads and stiffness are those of the last call.
  bool evaluate(const StepTime& step);
  /// Changes with the Biot coefficients of any load. Never 0.
  std::uint64_t alpha_version() const;
  /// Takes the present stress for that of the state from which displacements are counted, and begins to count.
  virtual void count_from_equilibrium() = 0;
  /// On a mesh that has changed: loads are counted from the same values as before; new cells have means.
  void keep_references(const LoadedRock& before, const MeshChange& change);
  /// Keeps the present stress and jumps of walls as those of such a state. Arguments as of SettledRock.
  void keep_settled(Vector forces, Vector displacements);
  /// Adds the jumps that walls have while u = 0 to those of the owned fracture cells, m.
  void add_jumps(Vector& owned) const;

  const Mesh& mesh_;
  Options options_;
  Origin origin_;
  Field& displacement_;
  Field* wall_traction_ = nullptr;  ///< exists with fractures only
  RockStiffness stiffness_;
  std::unique_ptr<FormulaOfCells> young_;  ///< nullptr where Young's modulus does not follow the state
  Vector ratio_;                           ///< present over initial Young's modulus, by cell; empty without a formula
  std::vector<PoreLoad> loads_;
  std::optional<SettledRock> settled_;  ///< the state from which displacements are counted, if it was settled
  Vector jumps_;                        ///< m, of walls while u = 0; empty where they are zero
  StepTime evaluated_for_;
  bool data_evaluated_ = false;
  bool loads_applied_ = false;  ///< whether the loads are in the constants of the equations
  std::uint64_t discretized_mesh_ = 0, discretized_stiffness_ = 0;
  long discretizations_ = 0;
  Vector initial_young_;  ///< Pa, one a cell; empty without a formula
  /// Takes Young's modulus of the initial state, as soon as all variables that its formula names have been offered.
  void take_initial_young();
  void use_initial_young(const Vector& values);

 private:
  double start_time_;
  std::vector<std::string> offered_;  ///< variables of the formula of Young's modulus
  std::uint64_t used_excavation_ = 0;
};

}  // namespace sprekk::poromechanics
