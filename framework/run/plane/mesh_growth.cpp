#include "framework/run/mesh_growth.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "framework/invariants.hpp"
#include "framework/linear/direct/kept_orderings.hpp"
#include "framework/run/plane/trial_meshes.hpp"
#include "framework/scene/plane/change_mesh.hpp"

namespace sprekk {

namespace {

/// Attempts a step with a trial of a search: of the tips only those that are searched for are examined.
StepStatus attempt_trial(Model& trial, GrowStep& grow, const StepTime& step) {
  struct FollowedOnly {
    explicit FollowedOnly(GrowStep& step) : grow(step) { grow.examine_followed_only(true); }
    ~FollowedOnly() { grow.examine_followed_only(false); }
    GrowStep& grow;
  } const followed_only(grow);
  return trial.attempt(step);
}

}  // namespace

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
  last_ = step;
  StepStatus status = is_holding() ? attempt_held(step) : attempt_within(step);
  if (status.converged) return status;
  for (const GrowStep* grow : model_->growing())
    if (grow->grows_within_step() && grow->was_run(step) && !grow->is_held() && !grow->may_shrink(step)) {
      model_->rewind();
      return attempt_held(step);
    }
  return status;
}

/// Whether tips whose growth within a step was not found still grow with the state held.
bool MeshGrowth::is_holding() const {
  return controller_.held() > 0 &&
         std::ranges::all_of(model_->growing(), [](const GrowStep* grow) { return grow->grows_within_step(); });
}

StepStatus MeshGrowth::attempt_held(const StepTime& step) {
  for (GrowStep* grow : model_->growing()) grow->choose(GrowStep::Holding::always);
  return model_->attempt(step);
}

StepStatus MeshGrowth::attempt_within(const StepTime& step) {
  const std::vector<GrowStep*>& growing = model_->growing();
  // The shortest step may end in a jump, which begins from the step without growth.
  if (growing.size() == 1 && growing[0]->grows_within_step() && growing[0]->may_shrink(step) &&
      growing[0]->component().grows_on()) {
    growing[0]->choose(GrowStep::Holding::never);
    const std::unique_ptr<FrontSearch> search = growing[0]->component().search_front(step, true, true);
    was_left_out_ = false;
    const StepStatus status = search ? search_front(0, *search, step) : StepStatus{};
    if (search && !was_left_out_) return status;
    model_->rewind();
  }
  for (GrowStep* grow : growing) grow->choose(GrowStep::Holding::if_far_above);
  const StepStatus status = model_->attempt(step);
  return status.converged ? find_front(step, status) : status;
}

double MeshGrowth::shortest_step(const GrowStep& grow) const {
  return grow.options().cut * model_->scene().time.step;  // as GrowStep::may_shrink
}

double MeshGrowth::longest_step() const {
  double longest = std::numeric_limits<double>::infinity();
  for (const GrowStep* grow : model_->growing()) {
    if (!grow->grows_within_step()) continue;
    longest = std::min(longest, std::max(shortest_step(*grow), grow->component().longest_step()));
  }
  return longest;
}

StepStatus MeshGrowth::find_front(const StepTime& step, const StepStatus& without_growth) {
  for (std::size_t i = 0; i < model_->growing().size(); ++i) {
    GrowStep& grow = *model_->growing()[i];
    if (!grow.grows_within_step() || grow.is_held() || !grow.was_run(step)) continue;
    grow.choose(GrowStep::Holding::never);
    const std::unique_ptr<FrontSearch> search = grow.component().search_front(step, grow.may_shrink(step), false);
    if (search) return search_front(i, *search, step);
  }
  return without_growth;
}

StepStatus MeshGrowth::search_front(std::size_t grow_step, FrontSearch& search, const StepTime& step) {
  model_->rewind();
  const KeptOrderings kept_orderings;  // the trial meshes have one topology
  TrialMeshes meshes(*model_, grow_step, step.start, log_, retire_);
  for (;;) {
    ++trials_;
    std::unique_ptr<Model> grown;
    Model* trial = model_.get();
    if (!search.paths().empty()) {
      try {
        MeshChangeResult changed = meshes.model_with(search.paths());
        if (!changed.settling.converged) {
          if (search.retreat()) continue;
          return {false, "the state could not be settled on the mesh that has grown: " + changed.settling.reason, 0};
        }
        smallest_angle_ = std::min(smallest_angle_, changed.smallest_angle);
        grown = std::move(changed.model);
      } catch (const ExtensionError& error) {
        if (search.give_up(error.extension(), error.what()) == FrontSearch::Verdict::again) continue;
        return refused(search, step);
      } catch (const std::runtime_error& error) {
        if (search.retreat()) continue;
        return {false, std::string("the mesh cannot follow a fracture: ") + error.what(), 0};
      }
      trial = grown.get();
    }
    std::optional<FrontSearch::Verdict> verdict;
    StepStatus status = evaluate(*trial, step, grow_step, search, verdict);
    if (!status.converged) {
      if (!grown) model_->rewind();
      if (search.retreat()) continue;
      shorten(step, status);
      return status;
    }
    was_left_out_ = !verdict;
    if (was_left_out_) {
      if (grown && retire_) retire_(*grown, nullptr);
      return status;
    }
    if (verdict == FrontSearch::Verdict::found) {
      if (!grown) return status;
      std::swap(model_, grown);
      ++changes_;
    }
    if (grown && retire_) retire_(*grown, nullptr);
    if (verdict == FrontSearch::Verdict::found) return status;
    if (!grown) model_->rewind();
    if (verdict == FrontSearch::Verdict::refused) return refused(search, step);
  }
}

StepStatus MeshGrowth::refused(const FrontSearch& search, const StepTime& step) {
  StepStatus status{false, search.reason(), 0, search.retry_dt()};
  shorten(step, status);
  return status;
}

/// Solves the step of a trial and lets the search learn from it. Tips that are not searched for grow in the trial that
/// is the right one. There is no verdict if growth is left out of the step or the step is not solved. Paths that come
/// too near to one another on the fine level count as a step that is not solved.
StepStatus MeshGrowth::evaluate(Model& trial, const StepTime& step, std::size_t grow_step, FrontSearch& search,
                                std::optional<FrontSearch::Verdict>& verdict) {
  GrowStep& grow = *trial.growing()[grow_step];
  try {
    const StepStatus status = attempt_trial(trial, grow, step);
    if (!status.converged || !grow.was_run(step)) return status;
    const FrontSearch::Verdict learnt = search.learn(grow.component(), step);
    if (learnt == FrontSearch::Verdict::found) {
      StepStatus others = grow.run(step);
      if (!others.converged) {
        others.reason = grow.describe() + ": " + others.reason;
        return others;
      }
      verdict = search.conclude(grow.component(), step);
    } else {
      verdict = learnt;
    }
    return status;
  } catch (const std::invalid_argument& error) {
    return {false, error.what(), 0};
  }
}

/// After this number of refusals because of growth, a step is no longer halved: the shortest step comes next.
void MeshGrowth::shorten(const StepTime& step, StepStatus& refused) {
  constexpr int halves = 3;  // each refusal costs some ten trials
  refusals_ = refused_at_ == step.start ? refusals_ + 1 : 1;
  refused_at_ = step.start;
  if (refusals_ < halves) return;
  refused.retry_dt = std::numeric_limits<double>::infinity();
  for (const GrowStep* grow : model_->growing())
    if (grow->grows_within_step()) refused.retry_dt = std::min(refused.retry_dt, shortest_step(*grow));
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

/// After a step with growth held, steps stay short until nothing grows.
MeshGrowth::Outcome MeshGrowth::follow_held(std::size_t grow_step) {
  const GrowStep& grow = *model_->growing()[grow_step];
  ++held_;
  const bool is_done = grow.has_come_to_rest();
  const double small = shortest_step(grow);
  const Outcome outcome = grow.extensions().empty() ? Outcome::nothing : take_over(grow_step);
  if (!is_done) controller_.hold(small);
  return outcome;
}

MeshGrowth::Outcome MeshGrowth::after_acceptance() {
  bool is_unsettled = false;
  double nearness = 0;
  if (is_holding()) controller_.release();  // the loop below holds it again if necessary
  for (std::size_t i = 0; i < model_->growing().size(); ++i) {
    const GrowStep& grow = *model_->growing()[i];
    if (grow.grows_within_step()) {
      if (!grow.was_run(last_)) continue;
      if (grow.is_held()) return follow_held(i);
      if (!grow.extensions().empty()) return take_over(i);
      continue;
    }
    is_unsettled = is_unsettled || grow.is_unsettled();
    nearness = std::max(nearness, grow.nearness());
    if (grow.extensions().empty()) continue;
    const double small = shortest_step(grow);
    const Outcome outcome = take_over(i);
    if (outcome == Outcome::changed) controller_.hold(small, nearness);
    return outcome;
  }
  if (!is_unsettled) controller_.release(nearness);
  controller_.observe(nearness);
  return Outcome::nothing;
}

}  // namespace sprekk
