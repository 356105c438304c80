// The models of the trials of a step: the accepted state on meshes with the paths that are tried.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "framework/scene/plane/change_mesh.hpp"

namespace sprekk {

/// Makes the models of the trials of one step. As long as the shapes of cells allow, a trial has the mesh of the trial
/// before, with moved tips, and the first trial the accepted mesh. So the state depends smoothly on the positions of
/// the tips, and the discretization around tips that go on stays the same.
/// Where cells have to be made anew (a path divides one, or those around tips have become too thin), the state is first
/// carried over with its tips at rest (MeshChange::is_at_rest). So the effect of other cells on the same state is kept
/// apart from growth, which follows.
class TrialMeshes {
 public:
  /// `retired`: a model that is not used any more.
  using Observer = std::function<void(const Model& retired, const Model*)>;
  /// `accepted` must outlive this object; the step begins at `time` (s).
  TrialMeshes(Model& accepted, std::size_t grow_step, double time, IterationLog log, Observer retire);
  ~TrialMeshes() { drop(); }

  /// The model with these paths, settled; each begins on the accepted mesh. Throws ExtensionError for a path that its
  /// fracture cannot take, std::runtime_error where no mesh can be made.
  MeshChangeResult model_with(const std::vector<PathExtension>& paths);

  /// The cells around tips: the present ones, except those that a path divides, or new ones.
  enum class Cells { same, anew };
  /// Carries the accepted state over to such cells, with tips at rest: the base of the next trials. False where that is
  /// not possible; the accepted state then is the base.
  bool rest(const std::vector<PathExtension>& paths, Cells cells);
  Model& base() const { return at_rest_ ? *at_rest_ : accepted_; }

 private:
  struct Made {
    std::vector<PathExtension> paths;
    GrownMesh mesh;
  };
  void drop();
  std::optional<GrownMesh> moved(const std::vector<PathExtension>& paths);
  MeshChangeResult change(const Model& model, GrownMesh mesh) const;
  static std::vector<PathExtension> paths_from_rest(std::vector<PathExtension> paths);
  std::vector<PathExtension> paths_from_base(const std::vector<PathExtension>& paths) const;

  Model& accepted_;
  std::size_t grow_step_;
  StepTime data_;  ///< with whose data states are settled
  IterationLog log_;
  Observer retire_;
  std::vector<PathExtension> paths_;  ///< of the last trial
  std::unique_ptr<Model> at_rest_;
  double smallest_angle_;  ///< rad, of the cells of at_rest_
  bool is_anew_ = false;   ///< whether at_rest_ has cells that were made anew
  std::optional<Made> made_;
};

}  // namespace sprekk
