// The state of a run, which changes from step to step and is stored in checkpoints.
#pragma once

#include <memory>

#include "framework/run/cumulative_balance.hpp"
#include "framework/run/splitting_error.hpp"
#include "framework/scene/model.hpp"
#include "framework/schedule/step_controller.hpp"

namespace sprekk {

/// The model with its fields, the step controller, the check of balances and the notes.
struct SimulationState {
  std::unique_ptr<Model> model;  ///< replaced each time that the mesh has grown
  StepController controller;
  CumulativeBalance balance = {};
  SplittingError splitting_error;
  Notes notes = {};  ///< of all accepted steps
};

}  // namespace sprekk
