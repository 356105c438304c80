// Every step of a run is attempted here: by the model alone where nothing grows (always so in space), else with the
// growth of fractures, which the mesh follows.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "framework/scene/model.hpp"
#include "framework/schedule/step_controller.hpp"

namespace sprekk {

/// Lets the mesh of a model follow the growth of fractures, and holds time steps small until the state has settled.
class MeshGrowth {
 public:
  /// Whether the mesh has changed, or could not be changed (see reason).
  enum class Outcome { nothing, changed, failed };

  /// `retired`: a model that is not used any more; `settled`: its successor, which has solved for nothing but its
  /// settling, or null where there is none.
  using Observer = std::function<void(const Model& retired, const Model* settled)>;

  /// `model` is replaced whenever its mesh grows; `retire` is called before. `model` and `controller` must outlive this
  /// object.
  MeshGrowth(std::unique_ptr<Model>& model, StepController& controller, IterationLog log = {}, Observer retire = {});

  /// To be called after a step that has converged, before it is accepted. `changed`: the step is to be repeated on the
  /// new mesh (GrowStep::repeats_step).
  Outcome before_acceptance();
  /// Solves a step. Where growth belongs to it (GrowStep::grows_within_step), finds the advance of the tips in the
  /// state at the end of the step: the model then is at the end of the step on the mesh with this advance. Returns the
  /// status of the step; without convergence the model is not rewound.
  ///
  /// The shortest step (GrowStep::may_shrink) does not fail for want of an advance: tips then grow with the state held,
  /// and in short steps, until the state has settled.
  StepStatus attempt(const StepTime& step);
  /// s, the longest next step in which tips that go on as fast as in the last step are followed; infinity where
  /// nothing grew.
  double longest_step() const;
  /// To be called after a step that has been accepted. The mesh takes growth over, and steps are held small until the
  /// state has settled.
  Outcome after_acceptance();

  const std::string& reason() const { return reason_; }  ///< of a failure
  long changes() const { return changes_; }
  long trials() const { return trials_; }  ///< evaluations of a step with an advance
  long held() const { return held_; }      ///< accepted steps, of growth within steps, with the state held
  double smallest_angle() const { return smallest_angle_; }  ///< rad, of all cells that were made for growth

 private:
  Outcome take_over(std::size_t grow_step);
  bool is_holding() const;
  double shortest_step(const GrowStep& grow) const;
  StepStatus attempt_within(const StepTime& step);
  StepStatus attempt_held(const StepTime& step);
  void shorten(const StepTime& step, StepStatus& refused);
  /// What a search for a front says of a step that is too long for it.
  StepStatus refused(const FrontSearch& search, const StepTime& step);
  Outcome follow_held(std::size_t grow_step);
  StepStatus evaluate(Model& trial, const StepTime& step, std::size_t grow_step, FrontSearch& search,
                      std::optional<FrontSearch::Verdict>& verdict);
  StepStatus find_front(const StepTime& step, const StepStatus& without_growth);
  StepStatus search_front(std::size_t grow_step, FrontSearch& search, const StepTime& step);

  std::unique_ptr<Model>& model_;
  StepController& controller_;
  IterationLog log_;
  Observer retire_;
  std::string reason_;
  static constexpr double above_all_triangles = 1.1;  ///< rad; their smallest angle is 60 degrees at most
  long changes_ = 0, trials_ = 0, held_ = 0;
  StepTime last_{};        ///< the step of the last attempt
  double refused_at_ = 0;  ///< s, start of the step whose growth was refused last
  int refusals_ = 0;       ///< refusals of the growth in the step from refused_at_
  double smallest_angle_ = above_all_triangles;
  int passes_ = 0;
  bool was_left_out_ = false;  ///< whether a `when` has left out the `grow` step in the last trial
};

}  // namespace sprekk
