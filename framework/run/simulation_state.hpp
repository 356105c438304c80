// What a run changes from step to step: all that its checkpoints hold.
#pragma once

#include <memory>

#include "framework/run/cumulative_balance.hpp"
#include "framework/scene/model.hpp"
#include "framework/schedule/step_controller.hpp"

namespace sprekk {

struct SimulationState {
  std::unique_ptr<Model> model;  ///< another one each time that the mesh has grown
  StepController controller;
  CumulativeBalance balance = {};
  Notes notes = {};  ///< of all accepted steps
};

}  // namespace sprekk
