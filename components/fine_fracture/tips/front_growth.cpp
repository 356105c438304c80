// Growth within a step: the tips propose paths, and learn from the state at the end of the step on the mesh with them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/fine_fracture/growth/front.hpp"
#include "components/fine_fracture/growth/jump.hpp"
#include "components/fine_fracture/growth/viscous_state.hpp"
#include "components/fine_fracture/growth/viscous_tip.hpp"
#include "components/fine_fracture/growth/way_of_tip.hpp"
#include "components/fine_fracture/tips/ends.hpp"
#include "components/fine_fracture/tips/tips.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/planar.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double full_segment = 1;          ///< of an increment: a longer segment is divided
constexpr double rest_of_segment = 0.5;     ///< of an increment: what of a divided segment is laid anew
constexpr double longest_segment = 1.5;     ///< of an increment: a longer one is divided in a short step, too
constexpr double turn_of_segment = 0.06;    ///< rad: one that turns further is divided when it is shorter
constexpr double least_full = 0.4;          ///< of the length of a straight segment that is divided
constexpr double least_advance = 0.05;      ///< of an increment: a step in which a tip advances by less divides nothing
constexpr double least_first_part = 0.2;    ///< of an increment: what stays of a first segment behind a kink
constexpr double largest_first_part = 0.8;  ///< of a first segment: the same
constexpr double longest_advance = 1.5;     ///< of an increment, in one step
constexpr double on_the_way = 0.2;          ///< of an increment: of nearer places only one gives a direction
constexpr double wanted_advance = 0.85;     ///< of an increment, of the fastest tip in one step
constexpr double carried_on = 0.5;          ///< of the change of speed between the last two steps: it has noise, too
constexpr double steady = 1.2;  ///< ratio of the speeds of two steps from which they tell no trend; largest one by it
constexpr double shorter_step = 0.5;  ///< the next attempt at a step that is too long

/// Of the last step and of the one before. Segments are divided every other step, and advances alternate with that.
double mean_of_steps(double last, double before) { return last != 0 && before != 0 ? (last + before) / 2 : last; }

double angle_of(const Point& direction) { return std::atan2(direction[1], direction[0]); }

}  // namespace

/// The search for the tips of one model. The model may be rewound meanwhile.
class TipsFront : public FrontSearch {
 public:
  TipsFront(Tips& tips, const StepTime& step, bool may_shrink, bool goes_on);

  bool is_needed() const { return !paths_.empty(); }
  const std::vector<PathExtension>& paths() const override { return paths_; }
  Verdict learn(Growing& trial, const StepTime& step) override;
  void give_up(int path, const std::string& why) override;
  bool retreat() override;
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
  double part_by_turn(const Tips::Tip& tip) const;
  double what_stays(const Tips::Tip& tip, const FrontTip& start) const;
  double speed(std::size_t tip) const;
  double trend() const;
  void add(Tips::Tip& tip);
  void find_joinings();
  void propose();
  Tips::Tip* same_tip(Tips& there, int tip) const;
  std::vector<PlaceOnWay> way_to(const Tips& there, const Tips::Tip& tip, const std::vector<PlaceOnWay>& before) const;
  Verdict finish(Tips& there);
  Verdict settle_for_less(Tips& there);
  bool begin_jump();
  void note_rest(double worst);
  Verdict end_jump(Tips& there);

  Tips& tips_;
  std::vector<Segment> segments_;
  std::vector<FrontTip> at_start_;
  std::vector<FrontState> states_, without_growth_;  ///< of the last trial; of the step without growth
  std::vector<double> scale_;      ///< Pa sqrt(m), K of viscous tips at the speed that is expected; 0 of others
  std::vector<char> is_blocked_;   ///< tips that stop in this step
  std::vector<char> is_followed_;  ///< by the mesh, from the start of the step on
  std::vector<PathExtension> joinings_;
  FrontOptions options_;
  std::unique_ptr<Front> front_;
  std::unique_ptr<FrontJump> jump_;  ///< where the front was not found in the shortest step
  std::vector<PathExtension> paths_;
  std::vector<int> tip_of_path_;
  std::vector<Tips::EndNote> notes_;
  std::string reason_;
  double dt_;
  bool may_shrink_;
  bool goes_on_;  ///< tips that grew in the last step do so in the first trial: the step has not been solved without
};

FrontState TipsFront::state_of(const Tips& tips, const Tips::Tip& tip) {
  if (!tips.is_followed(tip) || tip.now.is_stopped) return {{}, 0, false};
  return {tip.now.sifs, tip.now.load, tip.now.is_evaluated};
}

TipsFront::TipsFront(Tips& tips, const StepTime& step, bool may_shrink, bool goes_on)
    : tips_(tips), dt_(step.dt), may_shrink_(may_shrink), goes_on_(goes_on) {
  for (Tips::Tip& tip : tips_.tips_) add(tip);
  const double by_trend = trend();
  for (FrontTip& start : at_start_) start.speed *= by_trend;
  find_joinings();
  options_.increment = tips_.options_.growth.increment;
  options_.shortest = tips_.options_.growth.smallest_length();
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

/// The length at which the last segment is divided, over that of a straight one: an arc stands for a path that is
/// hardly bent. Beside a kink the path turns by up to 0.15 rad over an increment, and where an arc of this form was
/// divided K changed by 1.5 %.
double TipsFront::part_by_turn(const Tips::Tip& tip) const {
  if (!tip.now.segment_start) return 1;
  const Point end = tips_.end_direction(tip);
  const double turn = std::abs(std::atan2(cross(*tip.now.segment_start, end), tip.now.segment_start->dot(end)));
  return turn > turn_of_segment ? std::max(least_full, turn_of_segment / turn) : 1;
}

/// m, the part of the last segment that is not laid anew any more. The first segment behind a kink, where the path is
/// most curved and nothing tells how it begins, ends where the tip was when the mesh began to follow it.
double TipsFront::what_stays(const Tips::Tip& tip, const FrontTip& start) const {
  const std::vector<PlaceOnWay>& way = tip.now.way;
  const double increment = tips_.options_.growth.increment;
  if (way.empty()) return 0;
  // A step in which the tip hardly advances keeps its cells: dividing one would change K by more than the advance does.
  const bool is_short = start.speed > 0 && start.speed * dt_ < least_advance * increment;
  if (is_short && start.covered < longest_segment * increment) return 0;
  if (!tip.now.segment_start)
    for (const PlaceOnWay& place : way) {
      const double length = (place.position - start.anchor).norm();
      if (length > least_first_part * increment && length < largest_first_part * start.covered) return length;
    }
  const double full = full_segment * increment * part_by_turn(tip);
  return start.covered > full ? start.covered - rest_of_segment * full : 0;
}

/// The speed of all tips together in this step over its mean in the last two. How tips share it alternates with the
/// division of segments, but their sum hardly does. Where it changed much from one step to the other, it has no trend.
double TipsFront::trend() const {
  double last = 0, before = 0, part = 0;
  for (const Tips::Tip& tip : tips_.tips_) {
    const Tips::State& now = tip.now;
    if (!(now.speed > 0 && now.speed_before > 0 && now.lasted > 0 && now.lasted_before > 0)) continue;
    last += now.speed;
    before += now.speed_before;
    part = carried_on * (dt_ + now.lasted) / (now.lasted + now.lasted_before);
  }
  if (last > steady * before || before > steady * last || last == 0) return 1;
  return std::clamp((last + part * (last - before)) / (0.5 * (last + before)), 1 / steady, steady);
}

void TipsFront::add(Tips::Tip& tip) {
  tip.pattern.reset();
  tip.next_start.reset();
  const double increment = tips_.options_.growth.increment;
  const Point end = tips_.position(tip, {});
  const Point ahead = tip.now.is_extendable ? tips_.direction(tip) : tips_.end_direction(tip);
  FrontTip start;
  Segment segment;
  start.anchor = end;
  start.angle = start.ahead = angle_of(ahead);
  start.toughness = tips_.toughness(tip);
  start.size = fracture_length(tips_.mesh_, tip.end.fracture);
  start.speed = mean_of_steps(tip.now.speed, tip.now.speed_before);
  start.turning = mean_of_steps(tip.now.turning, tip.now.turning_before);
  start.goes_on = goes_on_ && tip.now.is_extendable && !tip.now.is_stopped && tip.now.speed > 0;
  if (tip.now.is_extendable) {
    start.covered = tips_.last_cell(tip.end).measure;
    segment.replaced = 1;
    start.anchor = end - start.covered * ahead;
    tip.next_start = tip.now.segment_start;
    if (const double stays = what_stays(tip, start); stays > 0) {
      // What stays leads to where the tip has been. The segment has turned since, as it grew.
      const PlaceOnWay place = place_on_way(start.anchor, tip.now.segment_start, tip.now.way, stays);
      start.anchor = place.position;
      start.covered = (end - start.anchor).norm();
      start.angle = angle_of(end - start.anchor);
      segment.before.push_back(start.anchor);
      tip.next_start = place.direction;
    }
    start.is_bent = tip.next_start.has_value();
    if (start.is_bent) start.ahead = start.angle;
  }
  FrontState state = state_of(tips_, tip);
  if (state.is_evaluated && !tip.now.path.added.empty()) {
    const Point way = tips_.position(tip, tip.now.path) - end;
    start.first_length = way.norm();
    start.first_angle = angle_of(way);
    start.least = (tips_.position(tip, tip.accepted.path) - end).norm();
  }
  // A tip that is at another fracture or at the boundary grows no more by increments.
  const bool wants = start.goes_on || start.first_length > 0 || state.load > 1;
  const double reach = start.first_length + longest_advance * increment;
  const double free = wants ? tips_.free_distance(tip, {}, end + reach * ahead) : reach;
  is_blocked_.push_back(wants && state.is_evaluated &&
                        free < std::max(start.first_length, tips_.options_.growth.smallest_length()));
  if (is_blocked_.back()) {
    state.is_evaluated = false;
    start.first_length = 0;
    start.goes_on = false;
  }
  start.longest = start.covered + std::min(reach, free);
  at_start_.push_back(start);
  segments_.push_back(segment);
  states_.push_back(state);
}

/// The rock that is left between a blocked tip and another fracture breaks at once.
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
    if (jump_ ? !jump_->is_laid(i) : !front_->is_laid(i)) continue;
    const double angle = jump_ ? jump_->angle(i) : front_->angle(i),
                 length = jump_ ? jump_->length(i) : front_->length(i);
    PathExtension extension{tips_.tips_[i].end.fracture, tips_.tips_[i].end.at_end, segments_[i].before};
    extension.points.push_back(at_start_[i].anchor + length * Point(std::cos(angle), std::sin(angle)));
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
    if (jump_) jump_->stop(tip);
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

/// m/s, of the advance in this trial. What the fine level had found before this step is no part of it.
double TipsFront::speed(std::size_t i) const {
  const int tip = static_cast<int>(i);
  const double length = jump_ ? jump_->length(i) : front_->length(tip);
  return std::max(0.0, length - std::max(at_start_[i].covered, at_start_[i].least)) / dt_;
}

FrontSearch::Verdict TipsFront::learn(Growing& trial, const StepTime&) {
  auto& there = dynamic_cast<Tips&>(trial);
  for (std::size_t i = 0; i < at_start_.size(); ++i) {
    states_[i] = {{}, 0, false};
    Tips::Tip* same = same_tip(there, static_cast<int>(i));
    if (!same) continue;
    if (!is_blocked_[i]) states_[i] = state_of(there, *same);
    if (scale_[i] > 0 && there.is_viscous(*same))
      states_[i] = against_viscosity(states_[i], there.apparent_toughness(*same, speed(i)), scale_[i]);
    // A tip that has grown on the fine level in this trial is followed from now on.
    if (!same->now.path.added.empty()) {
      const Point way = there.position(*same, same->now.path) - there.position(*same, {});
      front_->begin_with(static_cast<int>(i), way.norm(), angle_of(way));
    }
    tips_.tips_[i].pattern = same->pattern;
  }
  if (jump_) {
    jump_->learn(states_);
    if (jump_->verdict() != Front::Verdict::again) return end_jump(there);
    propose();
    return Verdict::again;
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

/// In the shortest step there is no stable growth, or none that was found: tips advance until they are below their
/// toughness.
FrontSearch::Verdict TipsFront::settle_for_less(Tips& there) {
  if (begin_jump()) return Verdict::again;
  note_rest(front_->worst());
  return finish(there);
}

void TipsFront::note_rest(double worst) {
  const std::string name = tips_.name();
  notes_.push_back({name + " is off its toughness",
                    fmt::format("tips of {} end a step with K_eq/K_IC off by {:.2g} (the advance was not found more "
                                "precisely)",
                                name, worst),
                    worst});
}

/// False where no tip can advance.
bool TipsFront::begin_jump() {
  jump_ = std::make_unique<FrontJump>(at_start_, without_growth_, options_);
  for (std::size_t i = 0; i < at_start_.size(); ++i)
    if (is_blocked_[i]) jump_->stop(static_cast<int>(i));
  if (jump_->verdict() != Front::Verdict::again) jump_.reset();
  if (jump_) propose();
  return jump_ != nullptr;
}

bool TipsFront::retreat() {
  if (may_shrink_) return false;
  if (!jump_) return begin_jump();
  if (!jump_->retreat()) return false;
  propose();
  return true;
}

FrontSearch::Verdict TipsFront::end_jump(Tips& there) {
  bool is_jump = false;
  for (std::size_t i = 0; i < at_start_.size(); ++i) {
    const FrontJump::Record& record = jump_->record(static_cast<int>(i));
    if (!(record.advance > 0) || (jump_->verdict() == Front::Verdict::found && !record.is_unstable)) continue;
    is_jump = true;
    const std::string name = tips_.name() + "." + tips_.tips_[i].name;
    const LameParameters lame = tips_.surroundings_->stiffness(at_start_[i].anchor);
    const double toughness = at_start_[i].toughness;
    const double energy = record.surplus * toughness * toughness / Elasticity{lame.lambda, lame.shear}.plane_modulus();
    notes_.push_back(
        {name + " jumps",
         fmt::format("{} jumps by {:.3g} mm in one step ({}) and {}; K_eq/K_IC is up to {:.4g} on the way, and {:.3g} "
                     "J/m of energy are left over",
                     name, 1e3 * record.advance,
                     record.is_unstable ? "its load rises with its length: growth is unstable"
                                        : "its load does not fall to the toughness nearby",
                     jump_->verdict() == Front::Verdict::found ? "comes to rest" : "goes on in the next one",
                     record.largest_load, energy),
         energy});
  }
  if (!is_jump) note_rest(jump_->worst());
  return finish(there);
}

/// The places of the tip in the last segment of the new mesh. `before`: in that of the mesh before the step. The first
/// place behind a kink counts however near the next ones are: the segment is divided there, in its direction.
std::vector<PlaceOnWay> TipsFront::way_to(const Tips& there, const Tips::Tip& tip,
                                          const std::vector<PlaceOnWay>& before) const {
  if (!tip.now.is_extendable) return {};
  const double least = on_the_way * tips_.options_.growth.increment;
  const Point end = there.position(tip, {}), ahead = there.direction(tip);
  const Point anchor = end - there.last_cell(tip.end).measure * ahead;
  std::vector<PlaceOnWay> way;
  for (const PlaceOnWay& place : before) {
    const bool is_first = !tip.now.segment_start && &place == &before.front();
    if ((place.position - anchor).dot(ahead) > least && (is_first || (place.position - end).norm() > least))
      way.push_back(place);
  }
  way.push_back({end, there.end_direction(tip)});
  return way;
}

FrontSearch::Verdict TipsFront::finish(Tips& there) {
  for (std::size_t i = 0; i < at_start_.size(); ++i) {
    Tips::Tip* same = same_tip(there, static_cast<int>(i));
    if (!same) continue;
    // A path that the fine level had found before this step is no growth in it.
    const double grown = same->now.grown - tips_.tips_[i].now.grown - at_start_[i].first_length;
    same->now.speed_before = tips_.tips_[i].now.speed;
    same->now.turning_before = tips_.tips_[i].now.turning;
    same->now.lasted_before = tips_.tips_[i].now.lasted;
    same->now.lasted = dt_;
    same->now.speed = std::max(0.0, grown) / dt_;
    same->now.apparent_toughness =
        speed(i) > 0 && there.is_viscous(*same) ? there.apparent_toughness(*same, speed(i)) : 0;
    const double advance = front_->length(static_cast<int>(i)) - at_start_[i].covered;
    same->now.turning = !jump_ && at_start_[i].covered > 0 && advance > 0
                            ? (front_->angle(static_cast<int>(i)) - at_start_[i].ahead) / advance
                            : 0;
    same->now.way = way_to(there, *same, tips_.tips_[i].now.way);
    same->now.has_started = same->now.has_started || (jump_ ? jump_->is_laid(i) : front_->grows(i));
    same->now.is_stopped = same->now.is_stopped || is_blocked_[i];
  }
  there.notes_.insert(there.notes_.end(), notes_.begin(), notes_.end());
  if (!jump_ && front_->trials() > 0) there.slopes_ = front_->slopes();
  return Verdict::found;
}

void Tips::prepare(Growing& other) const {
  for (Tip& tip : dynamic_cast<Tips&>(other).tips_)
    for (const Tip& same : tips_)
      if (is_same(same.end, tip.end)) tip.pattern = same.pattern, tip.next_start = same.next_start;
}

double Tips::apparent_toughness(const Tip& tip, double speed) const {
  const double viscosity = surroundings_->fluid_viscosity(tip.end.fracture, tip.end.at_end);
  const LameParameters lame = surroundings_->stiffness(position(tip, {}));
  const double at_rest = toughness(tip);
  const ViscousTip moving{at_rest, Elasticity{lame.lambda, lame.shear}.plane_modulus(), viscosity};
  const double full = moving.apparent_toughness(last_cell(tip.end).measure, speed);
  // Where the fluid lags behind the tip nothing viscous is near it, and its toughness alone counts.
  return at_rest * (1 + surroundings_->filled_part(tip.end.fracture, tip.end.at_end) * (full - 1));
}

bool Tips::is_viscous(const Tip& tip) const {
  return surroundings_->fluid_viscosity(tip.end.fracture, tip.end.at_end) > 0;
}

bool Tips::grows_on() const {
  if (!options_.toughness || !grows_within_steps_ || slopes_.size() == 0) return false;
  const auto is_settled = [](const Tip& tip) { return tip.now.is_stopped || tip.now.is_extendable; };
  return std::ranges::all_of(tips_, is_settled) &&
         std::ranges::any_of(tips_, [](const Tip& tip) { return !tip.now.is_stopped && tip.now.speed > 0; });
}

double Tips::longest_step() const {
  double fastest = 0;
  for (const Tip& tip : tips_)
    if (grows_within_steps_ && !tip.now.is_stopped) fastest = std::max(fastest, tip.now.speed);
  return fastest > 0 ? wanted_advance * options_.growth.increment / fastest : std::numeric_limits<double>::infinity();
}

std::unique_ptr<FrontSearch> Tips::search_front(const StepTime& step, bool may_shrink, bool goes_on) {
  if (!options_.toughness || !grows_within_steps_) return nullptr;
  if (goes_on) {
    notes_.clear();
    note_start(step);
  }
  auto search = std::make_unique<TipsFront>(*this, step, may_shrink, goes_on);
  if (search->is_needed()) return search;
  search->finish_without_growth();
  return nullptr;
}

}  // namespace sprekk::fine_fracture
