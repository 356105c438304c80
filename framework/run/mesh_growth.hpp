// Changes the mesh between two attempts at a step when fractures have grown.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "framework/scene/model.hpp"
#include "framework/schedule/step_controller.hpp"

namespace sprekk {

/// Lets the mesh of a model follow the growth of fractures, and holds time steps small until the state has settled.
class MeshGrowth {
 public:
  /// Whether the mesh has changed, or could not be changed (see reason).
  enum class Outcome { nothing, changed, failed };

  using Observer = std::function<void(const Model& before, const Model& after)>;

  /// `model` is replaced whenever its mesh grows; `changed` is called before, with both models. `model` and
  /// `controller` must outlive this object.
  MeshGrowth(std::unique_ptr<Model>& model, StepController& controller, IterationLog log = {}, Observer changed = {});

  /// To be called after a step that has converged, before it is accepted. `changed`: the step is to be repeated on the
  /// new mesh (GrowStep::repeats_step).
  Outcome before_acceptance();
  /// To be called after a step that has been accepted. The mesh takes growth over, and steps are held small until the
  /// state has settled.
  Outcome after_acceptance();

  const std::string& reason() const { return reason_; }  ///< of a failure
  long changes() const { return changes_; }
  double smallest_angle() const { return smallest_angle_; }  ///< rad, of all cells that were made for growth

 private:
  Outcome take_over(std::size_t grow_step);

  std::unique_ptr<Model>& model_;
  StepController& controller_;
  IterationLog log_;
  Observer changed_;
  std::string reason_;
  static constexpr double above_all_triangles = 1.1;  ///< rad; their smallest angle is 60 degrees at most
  long changes_ = 0;
  double smallest_angle_ = above_all_triangles;
  int passes_ = 0;
};

}  // namespace sprekk
