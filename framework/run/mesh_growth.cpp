#include "framework/run/mesh_growth.hpp"

#include <algorithm>

#include "framework/invariants.hpp"
#include "framework/scene/change_mesh.hpp"

namespace sprekk {

MeshGrowth::MeshGrowth(std::unique_ptr<Model>& model, StepController& controller, IterationLog log, Observer changed)
    : model_(model), controller_(controller), log_(std::move(log)), changed_(std::move(changed)) {}

/// Puts the model onto the mesh with the paths that the step has found, from its accepted state.
MeshGrowth::Outcome MeshGrowth::take_over(std::size_t grow_step) {
  SPREKK_EXPECT(grow_step < model_->growing().size(), grow_step);
  const double time = controller_.time(), standard = model_->scene().time.step;
  MeshChangeResult changed;
  try {
    changed = change_mesh(*model_, grow_step, model_->growing()[grow_step]->extensions(),
                          {time - standard, standard, time}, log_);
  } catch (const std::runtime_error& error) {
    reason_ = std::string("the mesh cannot follow a fracture: ") + error.what();
    return Outcome::failed;
  }
  smallest_angle_ = std::min(smallest_angle_, changed.smallest_angle);
  if (!changed.settling.converged) {
    reason_ = "the state could not be settled on the mesh that has grown: " + changed.settling.reason;
    return Outcome::failed;
  }
  SPREKK_ASSERT(changed.model != nullptr);
  if (changed_) changed_(*model_, *changed.model);
  model_ = std::move(changed.model);
  ++changes_;
  return Outcome::changed;
}

MeshGrowth::Outcome MeshGrowth::before_acceptance() {
  for (std::size_t i = 0; i < model_->growing().size(); ++i) {
    const GrowStep& grow = *model_->growing()[i];
    if (grow.extensions().empty() || !grow.repeats_step() || passes_ >= grow.options().passes) continue;
    ++passes_;
    return take_over(i);
  }
  passes_ = 0;
  return Outcome::nothing;
}

MeshGrowth::Outcome MeshGrowth::after_acceptance() {
  bool is_unsettled = false;
  double nearness = 0;
  for (std::size_t i = 0; i < model_->growing().size(); ++i) {
    const GrowStep& grow = *model_->growing()[i];
    is_unsettled = is_unsettled || grow.is_unsettled();
    nearness = std::max(nearness, grow.nearness());
    if (grow.extensions().empty()) continue;
    const double small = grow.options().cut * model_->scene().time.step;
    const Outcome outcome = take_over(i);
    if (outcome == Outcome::changed) controller_.hold(small, nearness);
    return outcome;
  }
  if (!is_unsettled) controller_.release(nearness);
  controller_.observe(nearness);
  return Outcome::nothing;
}

}  // namespace sprekk
