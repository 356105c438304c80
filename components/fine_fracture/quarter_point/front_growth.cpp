// Growth within a step: the tips propose paths, and learn from the state at the end of the step on the mesh with them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/fine_fracture/growth/front.hpp"
#include "components/fine_fracture/quarter_point/tips.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double full_segment = 1.5;      ///< of an increment: a longer segment is divided
constexpr double longest_advance = 1.5;   ///< of an increment, in one step
constexpr double acceptable_load = 0.02;  ///< of K_eq/K_IC, where the step may not become shorter
constexpr double shorter_step = 0.5;      ///< the next attempt at a step that is too long

double angle_of(const Point& direction) { return std::atan2(direction[1], direction[0]); }

}  // namespace

/// The search for the tips of one model. The model may be rewound meanwhile.
class TipsFront : public FrontSearch {
 public:
  TipsFront(Tips& tips, const StepTime& step, bool may_shrink);

  bool is_needed() const { return !paths_.empty(); }
  const std::vector<PathExtension>& paths() const override { return paths_; }
  Verdict learn(Growing& trial, const StepTime& step) override;
  void give_up(int path, const std::string& why) override;
  /// Tips that are blocked stop; everything else stays.
  void finish_without_growth() { finish(tips_); }
  std::string reason() const override { return reason_; }
  double retry_dt() const override { return shorter_step * dt_; }

 private:
  /// What of the last segment is laid anew.
  struct Segment {
    std::vector<Point> before;  ///< points of the path before the anchor
    int replaced = 0;           ///< fracture cells that are given up
  };
  static FrontState state_of(const Tips& tips, const Tips::Tip& tip);
  void add(Tips::Tip& tip);
  void find_joinings();
  void propose();
  Tips::Tip* same_tip(Tips& there, int tip) const;
  Verdict finish(Tips& there);
  Verdict settle_for_less(Tips& there);

  Tips& tips_;
  std::vector<Segment> segments_;
  std::vector<FrontTip> at_start_;
  std::vector<FrontState> states_;  ///< of the last trial
  std::vector<char> is_blocked_;    ///< tips that stop in this step
  std::vector<char> is_followed_;   ///< by the mesh, from the start of the step on
  std::vector<PathExtension> joinings_;
  std::unique_ptr<Front> front_;
  std::vector<PathExtension> paths_;
  std::vector<int> tip_of_path_;
  std::vector<Tips::EndNote> notes_;
  std::string reason_;
  double dt_;
  bool may_shrink_;
};

FrontState TipsFront::state_of(const Tips& tips, const Tips::Tip& tip) {
  if (!tips.is_followed(tip) || tip.now.is_stopped) return {{}, 0, false};
  return {tip.now.sifs, tip.now.load, tip.now.is_evaluated};
}

TipsFront::TipsFront(Tips& tips, const StepTime& step, bool may_shrink)
    : tips_(tips), dt_(step.dt), may_shrink_(may_shrink) {
  for (Tips::Tip& tip : tips_.tips_) add(tip);
  find_joinings();
  FrontOptions options;
  options.increment = tips_.options_.growth.increment;
  options.shortest = tips_.options_.growth.smallest_length();
  front_ = std::make_unique<Front>(at_start_, states_, options, step.dt, tips_.slopes_);
  propose();
}

void TipsFront::add(Tips::Tip& tip) {
  tip.pattern.reset();
  const double increment = tips_.options_.growth.increment;
  const Point end = tips_.position(tip, {}), ahead = tips_.direction(tip);
  FrontTip start;
  Segment segment;
  start.anchor = end;
  start.angle = angle_of(ahead);
  start.toughness = *tips_.options_.toughness;
  start.speed = tip.now.speed;
  if (tip.now.is_extendable) {
    start.covered = tips_.last_cell(tip.end).measure;
    segment.replaced = 1;
    start.anchor = end - start.covered * ahead;
    if (start.covered > full_segment * increment) {
      start.anchor += increment * ahead;
      start.covered -= increment;
      segment.before.push_back(start.anchor);
    }
  }
  FrontState state = state_of(tips_, tip);
  if (state.is_evaluated && !tip.now.path.added.empty()) {
    const Point way = tips_.position(tip, tip.now.path) - end;
    start.first_length = way.norm();
    start.first_angle = angle_of(way);
  }
  // A tip that is at another fracture or at the boundary grows no more by increments.
  const bool wants = start.first_length > 0 || state.load > 1;
  const double reach = start.first_length + longest_advance * increment;
  const double free = wants ? tips_.free_distance(tip, {}, end + reach * ahead) : reach;
  is_blocked_.push_back(wants && state.is_evaluated &&
                        free < std::max(start.first_length, tips_.options_.growth.smallest_length()));
  if (is_blocked_.back()) {
    state.is_evaluated = false;
    start.first_length = 0;
  }
  start.longest = start.covered + std::min(reach, free);
  is_followed_.push_back(tips_.is_followed(tip));
  at_start_.push_back(start);
  segments_.push_back(segment);
  states_.push_back(state);
}

/// What is left of the rock between a blocked tip and another fracture parts at once.
void TipsFront::find_joinings() {
  std::vector<std::pair<int, int>> joined;
  for (std::size_t i = 0; i < tips_.tips_.size(); ++i) {
    if (!is_blocked_[i] || tips_.options_.meeting != "join") continue;
    Tips::Tip& tip = tips_.tips_[i];
    TipOutcome outcome;
    outcome.ahead = tips_.direction(tip);
    const auto joining = tips_.find_joining(tip, outcome, joinings_, joined);
    if (!joining) continue;
    joined.emplace_back(tip.end.fracture, joining->other);
    joinings_.push_back(joining->extension);
  }
}

void TipsFront::propose() {
  paths_ = joinings_;
  tip_of_path_.assign(paths_.size(), none);
  for (std::size_t i = 0; i < at_start_.size(); ++i) {
    if (!front_->is_laid(i)) continue;
    const double angle = front_->angle(i);
    PathExtension extension{tips_.tips_[i].end.fracture, tips_.tips_[i].end.at_end, segments_[i].before};
    extension.points.push_back(at_start_[i].anchor + front_->length(i) * Point(std::cos(angle), std::sin(angle)));
    extension.replaced = segments_[i].replaced;
    extension.whole_segments = true;
    paths_.push_back(std::move(extension));
    tip_of_path_.push_back(static_cast<int>(i));
  }
}

void TipsFront::give_up(int path, const std::string& why) {
  const int tip = tip_of_path_[path];
  if (tip == none) {
    joinings_.erase(joinings_.begin() + path);
  } else {
    is_blocked_[tip] = 1;
    front_->stop(tip);
    const std::string name = tips_.name() + "." + tips_.tips_[tip].name;
    notes_.push_back({name + " is stopped: the mesh cannot follow",
                      fmt::format("{} stays where it is for good (the mesh cannot follow it: {})", name, why), 0});
  }
  propose();
}

Tips::Tip* TipsFront::same_tip(Tips& there, int tip) const {
  const TipEnd& end = tips_.tips_[tip].end;
  for (Tips::Tip& same : there.tips_)
    if (same.end.fracture == end.fracture && same.end.at_end == end.at_end) return &same;
  return nullptr;
}

FrontSearch::Verdict TipsFront::learn(Growing& trial, const StepTime&) {
  auto& there = dynamic_cast<Tips&>(trial);
  for (std::size_t i = 0; i < at_start_.size(); ++i) {
    states_[i] = {{}, 0, false};
    Tips::Tip* same = same_tip(there, static_cast<int>(i));
    if (!same) continue;
    // A tip that has come to grow on the fine level in a trial is followed from the next step on.
    if (!is_blocked_[i] && is_followed_[i]) states_[i] = state_of(there, *same);
    tips_.tips_[i].pattern = same->pattern;
  }
  if (front_->verdict() == Front::Verdict::again) front_->learn(states_);
  switch (front_->verdict()) {
    case Front::Verdict::again:
      propose();
      return Verdict::again;
    case Front::Verdict::found:
      return finish(there);
    case Front::Verdict::too_far:
    case Front::Verdict::failed:
      break;
  }
  reason_ = front_->reason();
  return may_shrink_ ? Verdict::refused : settle_for_less(there);
}

/// The shortest step is taken as it is where tips grow further than one increment, or nearly rest.
FrontSearch::Verdict TipsFront::settle_for_less(Tips& there) {
  if (front_->verdict() == Front::Verdict::failed && front_->worst() > acceptable_load) return Verdict::refused;
  const std::string name = tips_.name();
  notes_.push_back(
      front_->verdict() == Front::Verdict::too_far
          ? Tips::EndNote{name + " jumps",
                          fmt::format("tips of {} grow on without a rise of the load: they "
                                      "advance by increments in the shortest steps",
                                      name),
                          front_->worst()}
          : Tips::EndNote{name + " is off its toughness",
                          fmt::format("tips of {} end a step with K_eq/K_IC off by {:.2g} (the advance was "
                                      "not found more precisely)",
                                      name, front_->worst()),
                          front_->worst()});
  return finish(there);
}

FrontSearch::Verdict TipsFront::finish(Tips& there) {
  for (std::size_t i = 0; i < at_start_.size(); ++i) {
    Tips::Tip* same = same_tip(there, static_cast<int>(i));
    if (!same) continue;
    same->now.speed = (same->now.grown - tips_.tips_[i].now.grown) / dt_;
    same->now.has_started = same->now.has_started || front_->grows(i);
    same->now.is_stopped = same->now.is_stopped || is_blocked_[i];
  }
  there.notes_.insert(there.notes_.end(), notes_.begin(), notes_.end());
  there.slopes_ = front_->slopes();
  return Verdict::found;
}

std::unique_ptr<FrontSearch> Tips::search_front(const StepTime& step, bool may_shrink) {
  if (!options_.toughness || !grows_within_steps_) return nullptr;
  auto search = std::make_unique<TipsFront>(*this, step, may_shrink);
  if (search->is_needed()) return search;
  search->finish_without_growth();
  return nullptr;
}

}  // namespace sprekk::fine_fracture
