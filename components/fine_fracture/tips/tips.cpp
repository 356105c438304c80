#include "components/fine_fracture/tips/tips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "components/fine_fracture/tips/ends.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/mesh/topology_hash.hpp"

namespace sprekk::fine_fracture {

namespace {

TipEnd end_of(const PathExtension& extension) { return {extension.fracture, extension.at_end}; }

Sifs times(const Sifs& sifs, double factor) {
  return factor == 1 ? sifs : Sifs{factor * sifs.k1, factor * sifs.k2, factor * sifs.t_stress};
}

}  // namespace

Tips::Tips(const ComponentContext& context, const TipsOptions& options, std::unique_ptr<const FineLevelMaker> maker)
    : Component(context.name),
      mesh_(context.mesh),
      origin_(context.origin),
      options_(options),
      maker_(std::move(maker)) {
  check_increment();
  check_longest();
  for (const TipEnd& end : all_ends(mesh_)) {
    if (kind_of(mesh_, end) == FracturePoint::Kind::junction) joints_.push_back({end, name_of(mesh_, end)});
    if (kind_of(mesh_, end) != FracturePoint::Kind::tip) continue;
    Tip tip;
    tip.end = end;
    tip.name = name_of(mesh_, end);
    tip.coarse_size = original_size(mesh_, end);
    check_size(tip);
    check_shortest(tip);
    tips_.push_back(std::move(tip));
  }
}

void Tips::accept_surroundings(TipSurroundings& surroundings) {
  surroundings_ = &surroundings;
  if (surroundings.gives_jumps() && !maker_->takes_jumps())
    throw InputError(origin_, name() + " cannot take displacement jumps of walls from the coarse level",
                     "boundary elements find jumps from tractions; prescribed ones would be the only source of factors",
                     "choose 'reconstruction: wall_traction', fine_fracture/quarter_point or fine_fracture/jump_fit");
  if (maker_->needs_one_stiffness())
    for (const Tip& tip : tips_)
      if (!last_cell(tip.end).grown) check_rock(tip);
}

/// Displacements of the outline are linear over coarse cells: a square that cannot keep one of them away from its tip
/// has wrong factors (half of K_II with a quarter of a cell).
void Tips::check_size(const Tip& tip) const {
  const double least = 2 * tip.coarse_size / largest_enlargement;
  if (options_.size >= least) return;
  throw InputError(origin_,
                   fmt::format("'size' of {} is {:.4g} m, and the mesh at the tip {} has edges of {:.4g} m", name(),
                               options_.size, tip.name, tip.coarse_size),
                   fmt::format("the square around a tip, enlarged by half, must reach one of them beyond it: 'size' is "
                               "at least {:.4g} m; ten of them give factors within 1 %",
                               least),
                   "choose a larger 'size', or a smaller mesh.fracture_size");
}

/// A path grows in the square before the coarse level takes it over. It ends before the sides of the rock.
void Tips::check_increment() const {
  const double increment = options_.growth.increment, half = 0.5 * options_.size;
  const auto is_near_the_first = [&](const Point& x) {
    return (x - mesh_.nodes[0]).cwiseAbs().maxCoeff() <= options_.size;
  };
  if (!options_.toughness || increment <= half || std::ranges::all_of(mesh_.nodes, is_near_the_first)) return;
  throw InputError(
      origin_,
      fmt::format("'growth.increment' of {} is {:.4g} m, and 'size' is {:.4g} m", name(), increment, options_.size),
      fmt::format("an increment has to end in the square around its tip, which reaches {:.4g} m", half),
      "choose a shorter increment, or a larger 'size'");
}

/// With growth within steps an increment is one or two cells of the coarse level; with the state held it is one or two
/// edges of the fine level.
void Tips::check_shortest(const Tip& tip) const {
  constexpr double shortest = 0.01;  // of the cell at the tip
  const double least = shortest * tip.coarse_size;
  if (!options_.toughness || options_.growth.increment >= least) return;
  throw InputError(origin_,
                   fmt::format("'growth.increment' of {} is {:.4g} m, and the mesh at the tip {} has edges of {:.4g} m",
                               name(), options_.growth.increment, tip.name, tip.coarse_size),
                   fmt::format("segments of a path that are shorter than a hundredth of an edge ({:.4g} m) make a run "
                               "longer and no answer better: the edges limit it",
                               least),
                   "choose a longer increment, of half an edge for example, or a smaller mesh.fracture_size");
}

void Tips::check_longest() const {
  const GrowthOptions& growth = options_.growth;
  if (!options_.toughness || !growth.longest || *growth.longest >= growth.smallest_length()) return;
  throw InputError(origin_,
                   fmt::format("'growth.longest' of {} is {:.4g} m, and its shortest increment is {:.4g} m", name(),
                               *growth.longest, growth.smallest_length()),
                   "a tip grows by no less than 'smallest' times 'increment' at once: it could never grow",
                   "choose a larger 'longest', or leave it out: there is no limit then");
}

const FractureCell& Tips::last_cell(const TipEnd& end) const { return end_cell(mesh_, end); }

Point Tips::position(const Tip& tip, const TipPath& path) const {
  if (!path.added.empty()) return path.added.back();
  return end_point(mesh_, tip.end);
}

Point Tips::direction(const Tip& tip) const {
  const Point& tangent = end_cell(mesh_, tip.end).tangents;
  return tip.end.at_end ? tangent : Point(-tangent);
}

std::optional<Point> Tips::middle_of_last_segment(const Tip& tip) const {
  if (!tip.now.segment_start) return std::nullopt;
  const Point end = position(tip, {});
  return middle_of_arc(end - last_cell(tip.end).measure * direction(tip), *tip.now.segment_start, end);
}

Point Tips::end_direction(const Tip& tip) const {
  const std::optional<Point> middle = middle_of_last_segment(tip);
  return middle ? Point((position(tip, {}) - *middle).normalized()) : direction(tip);
}

std::vector<TipPath> Tips::paths_now() const {
  std::vector<TipPath> paths;
  for (const Tip& tip : tips_) paths.push_back(tip.now.path);
  return paths;
}

std::vector<FracturePath> Tips::paths_with(const std::vector<TipPath>& added) const {
  const TipPath nothing;
  std::vector<const TipPath*> of_end(2 * mesh_.fractures.size(), &nothing);
  std::vector<LastSegment> segments(of_end.size());
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    const std::size_t end = 2 * tips_[i].end.fracture + tips_[i].end.at_end;
    of_end[end] = &added[i];
    segments[end] = {tips_[i].now.is_extendable, middle_of_last_segment(tips_[i])};
  }
  std::vector<FracturePath> paths;
  for (int f = 0; f < static_cast<int>(mesh_.fractures.size()); ++f)
    paths.push_back(fracture_path(mesh_, f, *of_end[2 * f], *of_end[2 * f + 1], segments[2 * f], segments[2 * f + 1]));
  return paths;
}

void Tips::note_start(const StepTime& step) {
  if (examined_ == step.start) return;
  examined_ = step.start;
  for (Tip& tip : tips_) tip.length_at_start = tip.accepted.grown + length_of(position(tip, {}), tip.accepted.path);
  for (Joint& joint : joints_) joint.length_at_start = joint.grown;
}

double Tips::rest_tolerance() const { return options_.growth.seeks_arrest() ? options_.growth.arrest_tolerance : 0; }

Growing::Load Tips::examine(const StepTime& step) {
  note_start(step);
  surroundings_->update();
  notes_.clear();
  constexpr double safety = 2;  // the estimate may be too small by this factor
  const bool may_rule_out = options_.toughness && options_.skip_below > 0;
  Load loads;
  const std::vector<TipPath> paths = paths_now();
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    Tip& tip = tips_[i];
    if (is_held_) tip.now.speed = tip.now.turning = 0;
    if (tip.now.is_stopped) {
      tip.now.is_evaluated = false;
      continue;
    }
    const double now = surroundings_->fluid_pressure(tip.end.fracture, tip.end.at_end);
    const double before = surroundings_->accepted_fluid_pressure(tip.end.fracture, tip.end.at_end);
    if (now != before) loads.unsettled = std::max(loads.unsettled, std::abs(now - before) / std::max(now, before));
    const double estimate = may_rule_out && tip.now.path.added.empty() ? estimated_load(tip) : 0;
    if (tip.evaluated_for == surroundings_->version()) {
      ++kept_;
    } else if (may_rule_out && tip.now.path.added.empty() && safety * estimate < options_.skip_below) {
      ++skipped_;
      tip.now.is_evaluated = false;
      tip.now.load = estimate;
    } else {
      set_factors(tip, evaluate(i, paths));
      tip.evaluated_for = surroundings_->version();
    }
    if (turns_sharply(tip)) tip.now.is_extendable = false;
    // At the end of an increment the load is 1 within a tolerance; the tip must not grow again for that difference. A
    // tip that has not grown yet has no such tolerance: refused steps aim at the load 1 + overshoot/2, at which it has
    // to grow.
    if (is_followed(tip)) continue;
    const double rest = tip.now.has_started ? rest_tolerance() : 0;
    loads.now = std::max(loads.now, tip.now.load / (1 + rest));
    loads.accepted = std::max(loads.accepted, tip.accepted.load / (1 + rest));
    if (tip.now.has_started) continue;
    loads.onset = std::max(loads.onset, tip.now.load);
    loads.onset_accepted = std::max(loads.onset_accepted, tip.accepted.load);
  }
  return loads;
}

bool Tips::may_grow_within_steps() const {
  return options_.toughness && options_.growth.seeks_arrest() && options_.growth.is_implicit() && maker_->is_steady();
}

void Tips::grow_within_steps() {
  for (const auto& [is_wrong, option] :
       {std::pair(!options_.growth.seeks_arrest(), std::string("'growth.length: fixed'")),
        std::pair(!options_.growth.is_implicit(), "'growth.direction: " + options_.growth.direction + "'")})
    if (is_wrong)
      throw InputError(origin_, option + " has no meaning with growth within steps",
                       "lengths and directions follow from K_eq = K_IC and K_II = 0 at the end of each step",
                       "leave it out, or choose 'update: after_step'");
  grows_within_steps_ = true;
}

bool Tips::is_far_above() const {
  constexpr double violent = 1.5;  // K_eq over the toughness: twice the energy that growth takes
  return std::ranges::any_of(
      tips_, [&](const Tip& tip) { return !tip.now.is_stopped && tip.now.is_evaluated && tip.now.load > violent; });
}

bool Tips::turns_sharply(const Tip& tip) const {
  constexpr double sharp = 0.5;  // rad
  return tip.now.is_extendable && tip.now.is_evaluated && tip.now.load > 1 && tip.taken_over != examined_ &&
         std::abs(maximum_tangential_angle(tip.now.sifs)) > sharp;
}

bool Tips::is_near(const Tip& tip, const Tip& other) const {
  // The effect of an increment decreases with the square of its length over the distance.
  constexpr double far = 10;  // increments
  return tip.end.fracture == other.end.fracture ||
         (position(tip, tip.now.path) - position(other, other.now.path)).norm() < far * options_.growth.increment;
}

double Tips::free_distance(const Tip& tip, const TipPath& path, const Point& to) const {
  const Point from = position(tip, path);
  if (comes_too_near(mesh_, tip.end.fracture, position(tip, {}), from, to, cavity().size)) return 0;
  const sprekk::FreeLength free = sprekk::free_length(mesh_, tip.end.fracture, tip.end.at_end, from, to - from);
  return free.length - tip.coarse_size;
}

/// m, of a path that is passed to the coarse level.
double Tips::threshold(const Tip& tip) const {
  constexpr double with_the_step = 0.25, after_it = 0.5;  // of an edge of the coarse level
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
  tip.now.way.clear();
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

Growing::Growth Tips::grow(const StepTime&) {
  std::vector<GrowingTip> growing;
  std::vector<double> at_start;  // Pa m^0.5, K_IC of each tip; the search gets K scaled to this toughness
  const auto over_start = [&](int tip, const TipPath& path) {
    return toughness(tips_[tip].end, position(tips_[tip], path)) / at_start[tip];
  };
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
        return is_followed(tips_[tip]) ? tips_[tip].now.sifs
                                       : times(evaluate(tip, paths), 1 / over_start(tip, paths[tip]));
      },
      [this](int tip, const TipPath& path, const Point& to) {
        return tips_[tip].now.is_stopped ? 0 : free_distance(tips_[tip], path, to);
      },
      [this](int tip, int other) { return is_near(tips_[tip], tips_[other]); });
  for (std::size_t i = 0; i < tips_.size(); ++i)
    if (!is_followed(tips_[i]))
      outcomes[i].end = times(outcomes[i].end, over_start(static_cast<int>(i), outcomes[i].path));
  Growth result;
  std::vector<PathExtension>& extensions = result.extensions;
  std::vector<std::pair<int, int>> joined;
  std::vector<std::size_t> blocked, ended, met;
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    Tip& tip = tips_[i];
    if (is_followed(tip)) continue;
    const TipOutcome& outcome = outcomes[i];
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
    result.any = true;
    result.arrested = result.arrested && (outcome.arrested || outcome.blocked);
    if (!is_long_enough(tip, tip.now.path)) continue;
    extensions.push_back({tip.end.fracture, tip.end.at_end, coarse_path(tip, tip.now.path)});
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

/// The path with no edges shorter than half of the coarse mesh size, except for a single one (sec. 4.4.2 of the paper).
std::vector<Point> Tips::coarse_path(const Tip& tip, const TipPath& path) const {
  const double shortest = 0.5 * tip.coarse_size;
  std::vector<Point> points;
  Point last = position(tip, {});
  for (const Point& x : path.added) {
    if ((x - last).norm() < shortest) continue;
    points.push_back(x);
    last = x;
  }
  const Point& end = path.added.back();
  if (points.empty())
    points.push_back(end);
  else
    points.back() = end;
  return points;
}

CavityOptions Tips::cavity() const {
  double size = 0;
  for (const Tip& tip : tips_) size = std::max(size, tip.coarse_size);
  return {
      .radius = options_.cavity * size, .size = size, .growth = options_.cavity_growth, .rounds = grows_within_steps_};
}

std::uint64_t Tips::topology() const {
  TopologyHash hash;
  for (const Tip& tip : tips_) hash.add(tip.topology);
  return hash.value();
}

void Tips::accepted() {
  for (Tip& tip : tips_) {
    tip.accepted = tip.now;
    // The next step starts with a triangulation that follows from the geometry alone, as after a restart.
    if (tip.has_pattern) {
      tip.level.reset();
      tip.kept_factors.reset();
      tip.evaluated_for = 0;
      tip.pattern.reset();
      tip.has_pattern = false;
    }
  }
}

void Tips::rewound() {
  for (Tip& tip : tips_) {
    tip.now = tip.accepted;
    tip.evaluated_for = 0;
    tip.kept_factors.reset();
    // A repeated step starts without the trials of the refused one.
    tip.pattern.reset();
  }
  notes_.clear();
}

void Tips::carry_over(const Part& before, const MeshChange& change) {
  const auto& old = dynamic_cast<const Tips&>(before);
  examined_ = old.examined_;
  for (Tip& tip : tips_)
    for (const Tip& same : old.tips_) {
      if (!is_same(same.end, tip.end)) continue;
      tip.now = same.now;
      tip.length_at_start = same.length_at_start;
      tip.taken_over = same.taken_over;
      tip.pattern = same.pattern;
      tip.topology = same.topology;
      // The path is dropped here and not when it is handed over: a mesh that cannot take it would lose it.
      const double made = new_length(mesh_, tip.end, change), taken = made - given_up_length(mesh_, tip.end, change);
      if (made > 0) tip.now.segment_start = same.next_start;
      if (taken > 0) {
        tip.now.grown += taken;
        tip.now.is_extendable = grows_within_steps_;
        tip.taken_over = examined_;
        tip.now.path.added.clear();
      }
      tip.accepted = tip.now;
    }
  for (Joint& joint : joints_) {
    for (const Joint& same : old.joints_)
      if (is_same(same.end, joint.end)) joint.grown = same.grown, joint.length_at_start = same.length_at_start;
    for (const Tip& same : old.tips_) {
      if (!is_same(same.end, joint.end)) continue;
      joint.grown = same.now.grown + new_length(mesh_, joint.end, change);
      joint.length_at_start = same.length_at_start;
    }
  }
}

}  // namespace sprekk::fine_fracture
