#include "framework/run/mesh_growth.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "framework/invariants.hpp"
#include "framework/linear/direct/kept_orderings.hpp"
#include "framework/remeshing/move_tips.hpp"
#include "framework/scene/change_mesh.hpp"

namespace sprekk {

MeshGrowth::MeshGrowth(std::unique_ptr<Model>& model, StepController& controller, IterationLog log, Observer retire)
    : model_(model), controller_(controller), log_(std::move(log)), retire_(std::move(retire)) {}

/// Puts the model onto the mesh with the paths that the step has found, from its accepted state.
MeshGrowth::Outcome MeshGrowth::take_over(std::size_t grow_step) {
  SPREKK_EXPECT(grow_step < model_->growing().size(), grow_step);
  const double time = controller_.time(), standard = model_->scene().time.step;
  MeshChangeResult changed;
  try {
    changed = change_mesh(*model_, grow_step, grow_mesh(*model_, grow_step, model_->growing()[grow_step]->extensions()),
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
  if (retire_) retire_(*model_, changed.model.get());
  model_ = std::move(changed.model);
  ++changes_;
  return Outcome::changed;
}

StepStatus MeshGrowth::attempt(const StepTime& step) {
  const std::vector<GrowStep*>& growing = model_->growing();
  // The shortest step may end in a jump, which begins from the step without growth.
  if (growing.size() == 1 && growing[0]->grows_within_step() && growing[0]->may_shrink(step) &&
      growing[0]->component().grows_on()) {
    const std::unique_ptr<FrontSearch> search = growing[0]->component().search_front(step, true, true);
    was_left_out_ = false;
    const StepStatus status = search ? search_front(0, *search, step) : StepStatus{};
    if (search && !was_left_out_) return status;
    model_->rewind();
  }
  const StepStatus status = model_->attempt(step);
  return status.converged ? find_front(step, status) : status;
}

double MeshGrowth::longest_step() const {
  double longest = std::numeric_limits<double>::infinity();
  for (const GrowStep* grow : model_->growing()) {
    if (!grow->grows_within_step()) continue;
    const double smallest = grow->options().cut * model_->scene().time.step;  // as GrowStep::may_shrink
    longest = std::min(longest, std::max(smallest, grow->component().longest_step()));
  }
  return longest;
}

StepStatus MeshGrowth::find_front(const StepTime& step, const StepStatus& without_growth) {
  for (std::size_t i = 0; i < model_->growing().size(); ++i) {
    const GrowStep& grow = *model_->growing()[i];
    if (!grow.grows_within_step() || !grow.was_run(step)) continue;
    const std::unique_ptr<FrontSearch> search = grow.component().search_front(step, grow.may_shrink(step), false);
    if (search) return search_front(i, *search, step);
  }
  return without_growth;
}

namespace {

bool has_same_ends(const std::vector<PathExtension>& one, const std::vector<PathExtension>& other) {
  return std::ranges::equal(one, other, [](const PathExtension& a, const PathExtension& b) {
    return a.fracture == b.fracture && a.at_end == b.at_end && a.replaced == b.replaced &&
           a.points.size() == b.points.size();
  });
}

}  // namespace

/// The mesh of the next trial: the last one that was made anew, with moved tips, as long as its cells allow. So the
/// state depends smoothly on the positions of the tips.
GrownMesh MeshGrowth::trial_mesh(std::optional<TrialMesh>& made, std::size_t grow_step,
                                 const std::vector<PathExtension>& paths) {
  if (made && has_same_ends(made->paths, paths)) {
    std::optional<GrownMesh> moved = move_tips(model_->mesh(), made->mesh, paths, cavity_of(*model_, grow_step));
    if (moved) return std::move(*moved);
  }
  made = TrialMesh{paths, grow_mesh(*model_, grow_step, paths)};
  return made->mesh;
}

StepStatus MeshGrowth::search_front(std::size_t grow_step, FrontSearch& search, const StepTime& step) {
  const double time = step.start, standard = model_->scene().time.step;
  model_->rewind();
  const KeptOrderings kept_orderings;  // the trial meshes have one topology
  std::optional<TrialMesh> made;
  for (;;) {
    ++trials_;
    std::unique_ptr<Model> grown;
    Model* trial = model_.get();
    if (!search.paths().empty()) {
      try {
        MeshChangeResult changed = change_mesh(*model_, grow_step, trial_mesh(made, grow_step, search.paths()),
                                               {time - standard, standard, time}, log_);
        if (!changed.settling.converged) {
          if (search.retreat()) continue;
          return {false, "the state could not be settled on the mesh that has grown: " + changed.settling.reason, 0};
        }
        smallest_angle_ = std::min(smallest_angle_, changed.smallest_angle);
        grown = std::move(changed.model);
      } catch (const ExtensionError& error) {
        search.give_up(error.extension(), error.what());
        continue;
      } catch (const std::runtime_error& error) {
        if (search.retreat()) continue;
        return {false, std::string("the mesh cannot follow a fracture: ") + error.what(), 0};
      }
      trial = grown.get();
    }
    const StepStatus status = trial->attempt(step);
    if (!status.converged) {
      if (!grown) model_->rewind();
      if (search.retreat()) continue;
      return status;
    }
    was_left_out_ = !trial->growing()[grow_step]->was_run(step);
    if (was_left_out_) {
      if (grown && retire_) retire_(*grown, nullptr);
      return status;
    }
    const FrontSearch::Verdict verdict = search.learn(trial->growing()[grow_step]->component(), step);
    if (verdict == FrontSearch::Verdict::found) {
      if (!grown) return status;
      std::swap(model_, grown);
      ++changes_;
    }
    if (grown && retire_) retire_(*grown, nullptr);
    if (verdict == FrontSearch::Verdict::found) return status;
    if (!grown) model_->rewind();
    if (verdict == FrontSearch::Verdict::refused) return {false, search.reason(), 0, search.retry_dt()};
  }
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
    if (grow.grows_within_step()) continue;
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
