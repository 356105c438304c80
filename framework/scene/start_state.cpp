#include "framework/scene/start_state.hpp"

#include <stdexcept>

#include "framework/scene/state_of_run.hpp"

namespace sprekk {

void take_start(Model& model) {
  const StartOptions& start = model.scene().start;
  if (start.from) take_state_of_run(*start.from, model);
  const StepStatus status = model.settle_start();
  if (!status.converged)
    throw std::runtime_error("the state at the start cannot be settled (" + status.reason +
                             ") look at loads and at what holds the components of 'start: settle'");
}

}  // namespace sprekk
