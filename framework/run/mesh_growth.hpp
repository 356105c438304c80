// What a run does between two attempts at a step when fractures have grown.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "framework/scene/model.hpp"
#include "framework/schedule/step_controller.hpp"

namespace sprekk {

class MeshGrowth {
 public:
  enum class Outcome { nothing, changed, failed };

  using Observer = std::function<void(const Model& before, const Model& after)>;

  /// Replaces `model` whenever its mesh grows, and tells `changed` first. All must outlive this object.
  MeshGrowth(std::unique_ptr<Model>& model, StepController& controller, IterationLog log = {}, Observer changed = {});

  /// After a step that has converged, before it is accepted. changed: it is to be repeated (GrowStep, repeat_step).
  Outcome before_acceptance();
  /// After a step that has been accepted: the mesh takes growth over, and steps are held small until it has settled.
  Outcome after_acceptance();

  const std::string& reason() const { return reason_; }  ///< of a failure
  long changes() const { return changes_; }
  double smallest_angle() const { return smallest_angle_; }  ///< rad, of all cells that came with growth

 private:
  Outcome take_over(std::size_t grow_step);

  std::unique_ptr<Model>& model_;
  StepController& controller_;
  IterationLog log_;
  Observer changed_;
  std::string reason_;
  long changes_ = 0;
  double smallest_angle_ = 1.1;
  int passes_ = 0;
};

}  // namespace sprekk
