#include "components/fine_fracture/tips/tips_front.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "components/fine_fracture/growth/viscous_state.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/topology_hash.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double shorter_step = 0.5;  ///< the next attempt at a step that is too long: as `shrink` of `time:`
/// Tolerance of K_II/K_I, over that of ln K_eq: K_eq changes by the square of K_II/K_I.
constexpr double direction_over_load = 10;

}  // namespace

FrontState TipsFront::state_of(const Tips& tips, const Tips::Tip& tip) {
  if (!tips.is_followed(tip) || tip.now.is_stopped) return {{}, 0, false};
  return {tips.felt(tip), tip.now.load, tip.now.is_evaluated};
}

TipsFront::TipsFront(Tips& tips, const StepTime& step, bool may_shrink, bool goes_on)
    : tips_(tips), dt_(step.dt), may_shrink_(may_shrink), goes_on_(goes_on) {
  for (Tips::Tip& tip : tips_.tips_) add(tip);
  expect_speeds();
  end_blocked();
  options_.increment = tips_.options_.growth.increment;
  options_.shortest = tips_.options_.growth.smallest_length();
  options_.longest_jump = tips_.options_.growth.longest.value_or(options_.longest_jump);
  options_.load_tolerance = tips_.options_.growth.front_tolerance;
  options_.direction_tolerance = direction_over_load * options_.load_tolerance;
  for (std::size_t i = 0; i < tips_.tips_.size(); ++i) {
    const Tips::Tip& tip = tips_.tips_[i];
    const double expected = at_start_[i].speed > 0 ? at_start_[i].speed : options_.increment / dt_;
    scale_.push_back(tips_.is_viscous(tip) ? tips_.apparent_toughness(tip, expected) : 0);
    if (scale_[i] > 0) states_[i] = against_viscosity(states_[i], at_start_[i].toughness, scale_[i]);
  }
  without_growth_ = states_;
  front_ = std::make_unique<Front>(at_start_, states_, options_, step.dt, tips_.slopes_);
  propose();
}

void TipsFront::propose() {
  paths_ = joinings_;
  tip_of_path_.assign(paths_.size(), none);
  for (std::size_t i = 0; i < at_start_.size(); ++i) {
    if (jump_ ? !jump_->is_laid(i) : !front_->is_laid(i)) continue;
    Tips::Tip& tip = tips_.tips_[i];
    const double angle = front_->angle(i);
    const std::vector<Point> points =
        jump_ ? jump_->points(i)
              : std::vector{Point(at_start_[i].anchor + front_->length(i) * Point(std::cos(angle), std::sin(angle)))};
    PathExtension extension{tip.end.fracture, tip.end.at_end, segments_[i].before};
    extension.points.insert(extension.points.end(), points.begin(), points.end());
    extension.replaced = segments_[i].replaced;
    extension.divides = !segments_[i].before.empty();
    if (jump_) {
      tip.next_start = jump_->start(i);
      // A fine level around a tip that goes far is not moved with it.
      if (points.size() > 1) tip.pattern.reset();
    }
    extension.whole_segments = true;
    paths_.push_back(std::move(extension));
    tip_of_path_.push_back(static_cast<int>(i));
  }
}

FrontSearch::Verdict TipsFront::give_up(int path, const std::string& why) {
  const int tip = tip_of_path_[path];
  // The mesh could follow the first paths of this search, and cannot follow where it has led since: K falls steeply
  // with the advance, as next to stiffer rock. The search begins anew in a shorter step; in the shortest one tips jump.
  if (tip != none && !jump_ && front_->trials() > 0) {
    reason_ = why;
    if (may_shrink_) return Verdict::refused;
    if (begin_jump()) return Verdict::again;
  }
  // A jump that leads where the mesh cannot follow is tried with less: nearer to the last trial that was solved.
  if (tip != none && jump_ && jump_->retreat()) {
    propose();
    return Verdict::again;
  }
  if (tip == none) {
    joinings_.erase(joinings_.begin() + path);
  } else {
    is_blocked_[tip] = 1;
    front_->stop(tip);
    if (jump_) jump_->stop(tip);
    const std::string name = tips_.name() + "." + tips_.tips_[tip].name;
    notes_.push_back({name + " is stopped: the mesh cannot follow",
                      fmt::format("{} stays where it is for good (the mesh cannot follow it: {})", name, why), 0});
  }
  propose();
  return Verdict::again;
}

Tips::Tip* TipsFront::same_tip(Tips& there, int tip) const {
  const TipEnd& end = tips_.tips_[tip].end;
  for (Tips::Tip& same : there.tips_)
    if (same.end.fracture == end.fracture && same.end.at_end == end.at_end) return &same;
  return nullptr;
}

/// The speed of the advance in this trial, m/s. A path that the fine level had found before this step is not part of
/// the advance.
double TipsFront::speed(std::size_t i) const {
  const int tip = static_cast<int>(i);
  const double advance =
      jump_ ? jump_->advance(tip) : front_->length(tip) - std::max(at_start_[i].covered, at_start_[i].least);
  return std::max(0.0, advance) / dt_;
}

FrontState TipsFront::state_in_trial(const Tips& there, const Tips::Tip& same, std::size_t i) const {
  if (is_blocked_[i]) return {{}, 0, false};
  const FrontState state = state_of(there, same);
  return scale_[i] > 0 && there.is_viscous(same)
             ? against_viscosity(state, there.apparent_toughness(same, speed(i)), scale_[i])
             : state;
}

FrontSearch::Verdict TipsFront::learn(Growing& trial, const StepTime&) {
  auto& there = dynamic_cast<Tips&>(trial);
  for (std::size_t i = 0; i < at_start_.size(); ++i) {
    states_[i] = {{}, 0, false};
    Tips::Tip* same = same_tip(there, static_cast<int>(i));
    if (!same) continue;
    states_[i] = state_in_trial(there, *same, i);
    tips_.tips_[i].pattern = same->pattern;
  }
  if (jump_) {
    jump_->learn(states_);
    if (jump_->verdict() != Front::Verdict::again) return end_jump();
    propose();
    return Verdict::again;
  }
  TopologyHash topology;
  topology.add(topology_hash(there.mesh_));
  // The factors of other tips do not count in the search.
  for (const Tips::Tip& tip : there.tips_)
    if (there.is_followed(tip)) topology.add(tip.topology);
  if (topology_ && *topology_ != topology.value()) front_->change_mesh();
  topology_ = topology.value();
  if (front_->verdict() == Front::Verdict::again) front_->learn(states_);
  return decide();
}

/// What follows from the verdict of the front.
FrontSearch::Verdict TipsFront::decide() {
  switch (front_->verdict()) {
    case Front::Verdict::again:
      propose();
      return Verdict::again;
    case Front::Verdict::found:
      return Verdict::found;
    case Front::Verdict::too_far:
    case Front::Verdict::failed:
      break;
  }
  reason_ = front_->reason();
  return may_shrink_ ? Verdict::refused : settle_for_less();
}

/// A tip that has grown on the fine level in this trial, so far that the mesh can follow it, is followed from now on.
FrontSearch::Verdict TipsFront::conclude(Growing& trial, const StepTime&) {
  auto& there = dynamic_cast<Tips&>(trial);
  for (std::size_t i = 0; i < at_start_.size(); ++i) {
    Tips::Tip* same = same_tip(there, static_cast<int>(i));
    if (!same || same->now.path.added.empty()) continue;
    states_[i] = state_in_trial(there, *same, i);
    const Point way = there.position(*same, same->now.path) - there.position(*same, {});
    front_->begin_with(static_cast<int>(i), way.norm(), angle_of(way));
  }
  if (!jump_ && front_->verdict() == Front::Verdict::found) {
    front_->learn_of_others(states_);
    if (front_->verdict() != Front::Verdict::found)
      if (const Verdict next = decide(); next != Verdict::found) return next;
  }
  return finish(there);
}

FrontSearch::Verdict TipsFront::finish(Tips& there) {
  for (std::size_t i = 0; i < at_start_.size(); ++i) {
    Tips::Tip* same = same_tip(there, static_cast<int>(i));
    if (!same) continue;
    // A path that the fine level had found before this step is no growth in it.
    const double grown =
        same->now.grown - tips_.tips_[i].now.grown - std::max(at_start_[i].first_length, at_start_[i].least);
    same->now.speed_before = tips_.tips_[i].now.speed;
    same->now.turning_before = tips_.tips_[i].now.turning;
    same->now.lasted_before = tips_.tips_[i].now.lasted;
    same->now.lasted = dt_;
    same->now.speed = std::max(0.0, grown) / dt_;
    const bool is_followed = there.is_followed(*same);
    same->now.apparent_toughness = !is_followed                              ? there.resistance(*same, same->now.path)
                                   : speed(i) > 0 && there.is_viscous(*same) ? there.apparent_toughness(*same, speed(i))
                                                                             : 0;
    const double advance = front_->length(static_cast<int>(i)) - at_start_[i].covered;
    same->now.turning = !jump_ && at_start_[i].covered > 0 && advance > 0
                            ? (front_->angle(static_cast<int>(i)) - at_start_[i].ahead) / advance
                            : 0;
    same->now.was_laid = same->now.is_extendable;
    same->now.has_started = same->now.has_started || (jump_ ? jump_->is_laid(i) : front_->grows(i));
    same->now.is_stopped = same->now.is_stopped || is_blocked_[i];
  }
  if (!jump_ && front_->is_rough()) note_rough_front();
  there.notes_.insert(there.notes_.end(), notes_.begin(), notes_.end());
  if (!jump_ && front_->trials() > 0) there.slopes_ = front_->slopes();
  return Verdict::found;
}

double TipsFront::retry_dt() const { return shorter_step * dt_; }

}  // namespace sprekk::fine_fracture
