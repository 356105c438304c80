// One step of a run: attempts, ever smaller, until one has converged.
#pragma once

#include <optional>
#include <string>

#include "framework/output/profile.hpp"
#include "framework/output/progress.hpp"
#include "framework/run/effort.hpp"
#include "framework/run/mesh_growth.hpp"
#include "framework/run/simulation_state.hpp"

namespace sprekk {

class StepAttempts {
 public:
  enum class Outcome { converged, failed, interrupted };

  /// All must outlive this object.
  StepAttempts(SimulationState& state, MeshGrowth& growth, Effort& effort, Profile& profile, Progress& progress)
      : state_(state), growth_(growth), effort_(effort), profile_(profile), progress_(progress) {}

  /// Tries steps from the accepted state until one has converged on a mesh that it does not change any more, and leaves
  /// the model at its end. Otherwise the model is rewound, unless the mesh could not follow.
  Outcome run();

  const StepTime& step() const { return step_; }         ///< the last one tried
  int iterations() const { return status_.iterations; }  ///< of it
  const std::string& reason() const { return reason_; }  ///< why there is no step

 private:
  /// One attempt, which sets the status; when there cannot be another, how the step ends.
  std::optional<Outcome> attempt(bool may_be_interrupted);
  MeshGrowth::Outcome follow_growth();
  bool cut();
  Outcome give_up(const std::string& why);
  std::string name() const;  ///< of the step

  SimulationState& state_;
  MeshGrowth& growth_;
  Effort& effort_;
  Profile& profile_;
  Progress& progress_;
  StepTime step_;
  StepStatus status_;
  std::string reason_;
};

}  // namespace sprekk
