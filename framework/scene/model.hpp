// A scene that has been built: the mesh, the fields, the components, the couplers and the schedule.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/scene/scene.hpp"
#include "framework/schedule/grow_step.hpp"
#include "framework/schedule/schedule_step.hpp"
#include "framework/schedule/solve_step.hpp"

namespace sprekk {

/// Owns everything that is built from a scene, and attempts single time steps. A failed step rewinds to the accepted
/// state.
class Model {
 public:
  /// Builds everything and solves nothing. Throws InputError for combinations that cannot work: a missing capability,
  /// an input that a coupler should determine, an unknown that no step solves for, data without a value.
  Model(const Scene& scene, IterationLog log = {});
  /// Builds the scene on a given mesh: one that has grown, or that of a checkpoint.
  Model(const Scene& scene, Mesh mesh, IterationLog log = {});
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const Scene& scene() const { return scene_; }
  const Mesh& mesh() const { return mesh_; }
  FieldStore& fields() { return fields_; }
  const FieldStore& fields() const { return fields_; }
  ScheduleStep& schedule() { return *schedule_; }
  const ScheduleStep& schedule() const { return *schedule_; }
  const std::vector<Part*>& parts() const { return parts_; }
  const std::vector<std::unique_ptr<Component>>& components() const { return components_; }
  const std::vector<std::unique_ptr<Coupler>>& couplers() const { return couplers_; }
  const std::vector<Probe>& probes() const { return probes_; }

  /// Evaluates the data of a step and updates all discretizations, as `attempt` does first. Throws DataError.
  void prepare(const StepTime& step);
  /// Prepares the first step, and throws InputError if nothing determines the constant mode of some of its balances.
  /// Collective.
  void require_held();
  /// Attempts one step from the accepted state: prepares it and runs the schedule. If the step converges, the current
  /// values are those at its end. The caller accepts or rewinds. Throws DataError.
  StepStatus attempt(const StepTime& step);
  void accept();
  void rewind();

  /// Solves for the steady state of the components of `start: settle`, with everything else held and data as they are
  /// at the start. Accepts the state and lets parts count from there (CountsFromHere, CountsAmounts, KeepsTotals). Does
  /// nothing without it.
  StepStatus settle_start();

  /// The steps of the schedule that let the mesh grow.
  const std::vector<GrowStep*>& growing() const { return growing_; }
  /// The state that parts and the schedule keep outside of fields, for checkpoints.
  std::map<std::string, Vector> extra_state() const;
  void restore_extra_state(const std::map<std::string, Vector>& state);

  std::vector<double> switch_times() const;
  std::map<std::string, Balance> balances() const;  ///< of conserved quantities, by name
  std::vector<Quantity> quantities() const;         ///< for history.csv
  std::vector<OutputField> output() const;          ///< for pictures: fields, and what parts derive from them
  std::vector<PendingPath> pending_paths() const;   ///< of fractures that have grown further than the mesh knows
  Notes input_notes() const;                        ///< of the scene and of all parts
  /// Adds to input_notes.
  void add_note(const std::string& topic, const std::string& text) { scene_.notes.add(topic, text); }

 private:
  /// The solve of `start: settle`, where the scene has one.
  void build_settling(const ScheduleContext& context);
  void note_start();
  /// Makes the present state the reference from which changes and amounts are counted.
  void count_from_here(const SettledFields& settled);
  void check_outputs() const;
  /// Sets values to NaN where a component has none (LivesInPart).
  void hide_uninhabited(std::vector<OutputField>& fields) const;
  void check_determined() const;
  void check_stages() const;
  void check_data();
  /// Makes the status of a step that has lost an amount of a conserved quantity "not converged".
  void refuse_losses(const std::map<std::string, Balance>& before, const StepTime& step, StepStatus& status) const;
  /// Makes the status of a step that a part finds too long (LimitsStep) "not converged".
  void refuse_too_long(const StepTime& step, StepStatus& status) const;
  std::vector<OutputField> derived_output() const;  ///< what parts write beside their fields

  Scene scene_;
  Mesh mesh_;
  FieldStore fields_;
  std::vector<std::unique_ptr<Component>> components_;
  std::vector<std::unique_ptr<Coupler>> couplers_;
  std::vector<Part*> parts_;
  std::vector<GrowStep*> growing_;
  std::vector<KeepsState*> states_;  ///< of parts, then of steps of the schedule
  std::unique_ptr<ScheduleStep> schedule_;
  std::unique_ptr<SolveStep> settle_;  ///< solves for the state at the start, where the scene has `start: settle`
  std::vector<Probe> probes_;
};

}  // namespace sprekk
