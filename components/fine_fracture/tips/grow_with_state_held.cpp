// Growth with the state of the coarse level held: how far tips go, and which paths the mesh takes over.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "components/fine_fracture/growth/coarse_path.hpp"
#include "components/fine_fracture/tips/ends.hpp"
#include "components/fine_fracture/tips/tips.hpp"
#include "framework/remeshing/extension_check.hpp"
#include "framework/remeshing/free_length.hpp"

namespace sprekk::fine_fracture {
namespace {

TipEnd end_of(const PathExtension& extension) { return {extension.fracture, extension.at_end}; }

Sifs times(const Sifs& sifs, double factor) {
  return factor == 1 ? sifs : Sifs{factor * sifs.k1, factor * sifs.k2, factor * sifs.t_stress};
}

}  // namespace

bool Tips::is_near(const Tip& tip, const Tip& other) const {
  // The effect of an increment decreases with the square of its length over the distance.
  constexpr double far = 10;  // increments: with 5 two collinear cracks were tried
  return tip.end.fracture == other.end.fracture ||
         (position(tip, tip.now.path) - position(other, other.now.path)).norm() < far * options_.growth.increment;
}

/// A step towards `to` ends an edge of the coarse level before it would meet anything: only so far it may come too near
/// to something beside it.
double Tips::free_distance(const Tip& tip, const TipPath& path, const Point& to) const {
  const Point from = position(tip, path), way = to - from;
  const sprekk::FreeLength free = sprekk::free_length(mesh_, tip.end.fracture, tip.end.at_end, from, way);
  const double length = free.length - tip.coarse_size;
  if (!(length > 0)) return 0;
  const Point end = from + std::min(1.0, length / way.norm()) * way;
  if (comes_too_near(mesh_, tip.end.fracture, position(tip, {}), from, end, cavity().size)) return 0;
  return length;
}

/// m, of a path that is passed to the coarse level.
double Tips::threshold(const Tip& tip) const {
  constexpr double with_the_step = 0.25, after_it = 0.5;  // of an edge of the coarse level: as in the paper
  return surroundings_->propagation_threshold().value_or(grows_within_steps_ ? with_the_step : after_it) *
         tip.coarse_size;
}

double Tips::longest_path(const Tip& tip) const { return std::max(threshold(tip), options_.growth.increment); }

bool Tips::is_long_enough(const Tip& tip, const TipPath& path) const {
  // Whole increments may fall short of the threshold by what their last one was shortened.
  constexpr double nearly = 0.95;
  return length_of(position(tip, {}), path) >= nearly * threshold(tip);
}

/// The last segment stays where it is: a path that grows with the state held begins at the tip.
void Tips::leave_last_segment(Tip& tip, const TipPath& path) {
  tip.now.speed = (length_of(position(tip, {}), path) - length_of(position(tip, {}), tip.now.path)) / step_.dt;
  tip.now.lasted = tip.now.lasted_before = 0;
  tip.now.is_extendable = false;
  tip.now.was_laid = false;
  tip.next_start.reset();
  const std::string topic = name() + " grows with the state held";
  const auto is_told = [&](const EndNote& note) { return note.topic == topic; };
  if (std::ranges::none_of(notes_, is_told))
    notes_.push_back({topic,
                      fmt::format("tips of {} grow in a step with the state held: their advance within it was not "
                                  "found, or began at {:.3g} times the load of growth",
                                  name(), tip.now.load),
                      tip.now.load});
}

std::vector<TipOutcome> Tips::find_outcomes() {
  std::vector<GrowingTip> growing;
  std::vector<double> at_start;            // Pa m^0.5, K_IC of each tip; the search gets K scaled to this toughness
  using TakenFor = std::pair<Sifs, Sifs>;  // factors as the search takes them, and as they are
  std::vector<std::vector<TakenFor>> seen(tips_.size());
  const auto as_they_are = [&](std::size_t tip, const Sifs& taken) {
    const auto found = std::ranges::find_if(
        seen[tip], [&](const TakenFor& pair) { return pair.first.k1 == taken.k1 && pair.first.k2 == taken.k2; });
    return found != seen[tip].end() ? found->second : taken;
  };
  const auto over_start = [&](int tip, const TipPath& path) { return resistance(tips_[tip], path) / at_start[tip]; };
  for (const Tip& tip : tips_) {
    const LameParameters lame = surroundings_->stiffness(position(tip, {}));
    // A tip that the mesh follows has its own search; here it stays.
    at_start.push_back(toughness(tip));
    growing.push_back({position(tip, {}), direction(tip),
                       is_followed(tip) ? std::numeric_limits<double>::max() : at_start.back(),
                       Elasticity{lame.lambda, lame.shear}.plane_modulus(), tip.now.path, tip.now.warm_start});
  }
  GrowthOptions growth = options_.growth;
  // Longer growth needs a new solution of the coarse level: the pressure of the fluid falls as tips grow.
  if (!growth.longest)
    for (const Tip& tip : tips_) growth.longest = std::max(growth.longest.value_or(0), longest_path(tip));
  std::vector<TipOutcome> outcomes = grow_tips(
      growing, growth,
      // What others grow here counts for a tip that the mesh follows from the next step on. Otherwise the topology of
      // its fine level would change from trial to trial, and its factors with it.
      [&](int tip, const std::vector<TipPath>& paths) {
        if (is_followed(tips_[tip])) return tips_[tip].now.sifs;
        const Sifs sifs = evaluate(tip, paths);
        seen[tip].emplace_back(times(felt(tips_[tip], paths[tip], sifs), 1 / over_start(tip, paths[tip])), sifs);
        return seen[tip].back().first;
      },
      [this](int tip, const TipPath& path, const Point& to) {
        return tips_[tip].now.is_stopped ? 0 : free_distance(tips_[tip], path, to);
      },
      [this](int tip, int other) { return is_near(tips_[tip], tips_[other]); });
  for (std::size_t i = 0; i < tips_.size(); ++i)
    for (Sifs* sifs : {&outcomes[i].start, &outcomes[i].end}) *sifs = as_they_are(i, *sifs);
  return outcomes;
}

Growing::Growth Tips::grow(const StepTime&) {
  std::vector<TipOutcome> outcomes = find_outcomes();
  Growth result;
  std::vector<PathExtension>& extensions = result.extensions;
  std::vector<std::pair<int, int>> joined;
  std::vector<std::size_t> blocked, ended, met;
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    Tip& tip = tips_[i];
    if (is_followed(tip)) continue;
    const TipOutcome& outcome = outcomes[i];
    if (outcome.increments > 0) result.load = std::max(result.load, growth_load(tip));
    tip.now.has_started = tip.now.has_started || outcome.increments > 0 || tip.now.load >= 1 + rest_tolerance();
    increments_ += outcome.increments;
    const bool was_stopped = tip.now.is_stopped;
    tip.now.is_stopped = was_stopped || outcome.blocked;
    if (outcome.increments > 0) {
      if (is_held_) leave_last_segment(tip, outcome.path);
      tip.now.path = outcome.path;
      set_factors(tip, outcome.end);
    }
    if (!was_stopped) ended.push_back(i);
    tip.now.warm_start = outcome.warm_start;
    if (outcome.blocked && options_.meeting == "join") blocked.push_back(i);
    if (outcome.increments == 0) continue;
    result.arrested = result.arrested && (outcome.arrested || outcome.blocked);
    if (!is_long_enough(tip, tip.now.path)) continue;
    extensions.push_back({tip.end.fracture, tip.end.at_end,
                          coarse_path(position(tip, {}), tip.now.path.added, tip.coarse_size, SharpBends::stay)});
  }
  stop_refused(extensions, outcomes);
  // Tips join other fractures last, when the paths of all others are known. A path that joins a fracture replaces the
  // former path of its tip.
  for (const std::size_t i : blocked) {
    Tip& tip = tips_[i];
    std::vector<PathExtension> others;
    for (const PathExtension& other : extensions)
      if (!is_same(end_of(other), tip.end)) others.push_back(other);
    const std::optional<Joining> joining = find_joining(tip, outcomes[i], others, joined);
    if (!joining) continue;
    tip.now.path.added.push_back(joining->extension.points.back());
    joined.emplace_back(tip.end.fracture, joining->other);
    extensions = std::move(others);
    extensions.push_back(joining->extension);
    met.push_back(i);
  }
  for (const std::size_t i : ended) note_end(tips_[i], outcomes[i], std::ranges::count(met, i) > 0);
  if (grows_within_steps_ && !is_held_)
    std::erase_if(extensions, [&](const PathExtension& extension) {
      return std::ranges::none_of(met, [&](std::size_t i) { return is_same(tips_[i].end, end_of(extension)); });
    });
  return result;
}

}  // namespace sprekk::fine_fracture
