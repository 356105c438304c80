// One step of a run: attempts, ever smaller, until one has converged.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "framework/output/profile.hpp"
#include "framework/output/progress.hpp"
#include "framework/run/effort.hpp"
#include "framework/run/mesh_growth.hpp"
#include "framework/run/simulation_state.hpp"

namespace sprekk {

/// Attempts one step of a run.
class StepAttempts {
 public:
  /// How the step has ended.
  enum class Outcome { converged, failed, interrupted };

  /// All must outlive this object.
  StepAttempts(SimulationState& state, MeshGrowth& growth, Effort& effort, Profile& profile, Progress& progress)
      : state_(state), growth_(growth), effort_(effort), profile_(profile), progress_(progress) {}

  /// Tries steps from the accepted state until one has converged on a mesh that no longer changes, and leaves the model
  /// at the end of that step. Otherwise the model is rewound, unless the mesh could not be changed.
  Outcome run();

  const StepTime& step() const { return step_; }         ///< the last one tried
  const StepStatus& status() const { return status_; }   ///< how the last attempt ended
  const std::string& reason() const { return reason_; }  ///< why there is no step

 private:
  /// Makes one attempt and sets the status. Returns the outcome of the step when no other attempt is to follow.
  std::optional<Outcome> try_once(bool may_be_interrupted);
  StepTime next_step() const;
  /// Finds the longest step that all parts allow. Returns why it is below the smallest one, else an empty text.
  /// Collective.
  std::string limit_steps();
  MeshGrowth::Outcome follow_growth();
  bool cut();
  void note_cut();
  Outcome give_up(const std::string& why);
  std::string name() const;  ///< of the step

  SimulationState& state_;
  MeshGrowth& growth_;
  Effort& effort_;
  Profile& profile_;
  Progress& progress_;
  double longest_ = std::numeric_limits<double>::infinity();  ///< s, of this step, by parts that limit it
  StepTime step_;
  StepStatus status_;
  std::string reason_;
};

}  // namespace sprekk
