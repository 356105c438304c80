#include "components/fine_fracture/quarter_point/tips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "components/fine_fracture/quarter_point/elasticity/adapt.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::fine_fracture {

namespace {

const FractureCell& end_cell(const Mesh& mesh, const TipEnd& end) {
  const Fracture& cells = mesh.fractures[end.fracture];
  return mesh.fracture_cells[cells.first_cell + (end.at_end ? cells.cell_count - 1 : 0)];
}

FracturePoint::Kind kind_of(const Mesh& mesh, const TipEnd& end) {
  return mesh.fracture_points[end_cell(mesh, end).points[end.at_end ? 1 : 0]].kind;
}

std::string name_of(const Mesh& mesh, const TipEnd& end) {
  return mesh.fractures[end.fracture].name + (end.at_end ? "_last" : "_first");
}

std::vector<TipEnd> all_ends(const Mesh& mesh) {
  std::vector<TipEnd> ends;
  for (int f = 0; f < static_cast<int>(mesh.fractures.size()); ++f)
    for (const bool at_end : {false, true}) ends.push_back({f, at_end});
  return ends;
}

bool is_same(const TipEnd& a, const TipEnd& b) { return a.fracture == b.fracture && a.at_end == b.at_end; }

/// The size of the original fracture's cell at this end.
double original_size(const Mesh& mesh, const TipEnd& end) {
  const Fracture& cells = mesh.fractures[end.fracture];
  for (int i = 0; i < cells.cell_count; ++i) {
    const FractureCell& cell = mesh.fracture_cells[cells.first_cell + (end.at_end ? cells.cell_count - 1 - i : i)];
    if (!cell.grown) return cell.measure;
  }
  return end_cell(mesh, end).measure;
}

/// The length of the fracture's new cells at this end, m.
double new_length(const Mesh& mesh, const TipEnd& end, const MeshChange& change) {
  const Fracture& cells = mesh.fractures[end.fracture];
  double length = 0;
  for (int i = 0; i < cells.cell_count; ++i) {
    const int cell = cells.first_cell + (end.at_end ? cells.cell_count - 1 - i : i);
    if (change.fracture_cell[cell] != none) break;
    length += mesh.fracture_cells[cell].measure;
  }
  return length;
}

/// The length of the fracture's cells at this end that were given up for new ones, m.
double given_up_length(const Mesh& mesh, const TipEnd& end, const MeshChange& change) {
  const Fracture& cells = mesh.fractures[end.fracture];
  double length = 0;
  for (int i = 0; i < cells.cell_count; ++i) {
    const int cell = cells.first_cell + (end.at_end ? cells.cell_count - 1 - i : i);
    if (change.fracture_cell[cell] != none) break;
    for (const ReplacedPart& part : change.replaced_parts)
      if (part.cell == cell) length += part.length;
  }
  return length;
}

double length_of(const Point& from, const TipPath& path) {
  double length = 0;
  Point last = from;
  for (const Point& x : path.added) {
    length += (x - last).norm();
    last = x;
  }
  return length;
}

}  // namespace

Tips::Tips(const ComponentContext& context, const TipsOptions& options)
    : Component(context.name), mesh_(context.mesh), options_(options) {
  for (const TipEnd& end : all_ends(mesh_)) {
    if (kind_of(mesh_, end) == FracturePoint::Kind::junction) joints_.push_back({end, name_of(mesh_, end)});
    if (kind_of(mesh_, end) != FracturePoint::Kind::tip) continue;
    Tip tip;
    tip.end = end;
    tip.name = name_of(mesh_, end);
    tip.coarse_size = original_size(mesh_, end);
    tips_.push_back(std::move(tip));
  }
}

const FractureCell& Tips::last_cell(const TipEnd& end) const { return end_cell(mesh_, end); }

Point Tips::position(const Tip& tip, const TipPath& path) const {
  if (!path.added.empty()) return path.added.back();
  return mesh_.fracture_points[end_cell(mesh_, tip.end).points[tip.end.at_end ? 1 : 0]].position;
}

Point Tips::direction(const Tip& tip) const {
  const Point& tangent = end_cell(mesh_, tip.end).tangents;
  return tip.end.at_end ? tangent : Point(-tangent);
}

std::vector<TipPath> Tips::paths_now() const {
  std::vector<TipPath> paths;
  for (const Tip& tip : tips_) paths.push_back(tip.now.path);
  return paths;
}

std::vector<FracturePath> Tips::paths_with(const std::vector<TipPath>& added) const {
  const TipPath nothing;
  std::vector<const TipPath*> of_end(2 * mesh_.fractures.size(), &nothing);
  for (std::size_t i = 0; i < tips_.size(); ++i) of_end[2 * tips_[i].end.fracture + tips_[i].end.at_end] = &added[i];
  std::vector<FracturePath> paths;
  for (int f = 0; f < static_cast<int>(mesh_.fractures.size()); ++f)
    paths.push_back(fracture_path(mesh_, f, *of_end[2 * f], *of_end[2 * f + 1]));
  return paths;
}

namespace {

bool is_same(const FineGeometry& a, const FineGeometry& b) {
  return a.outline == b.outline &&
         std::equal(a.cracks.begin(), a.cracks.end(), b.cracks.begin(), b.cracks.end(),
                    [](const CrackPath& x, const CrackPath& y) { return x.points == y.points && x.walls == y.walls; });
}

}  // namespace

Sifs Tips::evaluate(std::size_t index, const std::vector<TipPath>& paths) {
  Tip& tip = tips_[index];
  // The square stays where the coarse tip is while the path grows in it.
  const Point center = position(tip, {});
  FineMeshOptions mesh;
  mesh.tip_size = options_.mesh_ratio * tip.coarse_size;
  constexpr double edges_across = 10;  // of the domain, away from the fractures; the estimated error refines them
  mesh.far_size = std::max(mesh.tip_size, options_.size / edges_across);
  mesh.sectors = options_.sectors;
  const auto walls = surroundings_->gives_jumps() ? CrackPath::Walls::jump : CrackPath::Walls::traction;
  FineDomain domain = fine_domain(mesh_, paths_with(paths), tip.end, center, options_.size, tip.coarse_size, walls,
                                  tip.pattern ? &tip.pattern->geometry.outline : nullptr);
  const LameParameters lame = surroundings_->stiffness(center);
  const Elasticity rock{lame.lambda, lame.shear};
  if (!tip.model || !(tip.model->rock() == rock) || !is_same(domain.geometry, tip.domain.geometry)) {
    tip.kept_factors.reset();
    tip.offsets = nullptr;
    tip.domain = std::move(domain);
    if (options_.tolerance) {
      Adapted adapted =
          adapt(tip.domain.geometry, mesh, rock, loads_of(tip), {.tolerance = *options_.tolerance}, profile_);
      tip.model.emplace(std::move(adapted.model));
      meshes_ += adapted.meshes;
      solves_ += adapted.meshes;
      return keep_factors(tip, adapted.solution);
    }
    const bool keeps_pattern = is_followed(tip);
    tip.model.emplace(tip.domain.geometry, mesh, rock, TipPlace{tip.domain.crack, tip.domain.is_last}, profile_,
                      keeps_pattern ? &tip.pattern : nullptr);
    tip.has_pattern = keeps_pattern;
    ++meshes_;
  } else {
    tip.domain = std::move(domain);
  }
  // The kept factors are still valid if only paths outside of its domain have changed, or at the first evaluation of a
  // search.
  if (tip.kept_factors && tip.kept_factors->version == surroundings_->version()) {
    ++kept_;
    tip.now.sif_error = tip.kept_factors->error;
    return tip.kept_factors->sifs;
  }
  ++solves_;
  FineLoads loads = loads_of(tip);
  if (!tip.offsets) tip.offsets = surroundings_->stress_offsets(tip.model->offset_places());
  loads.stress_offset = [&tip](const std::vector<Point>&) { return tip.offsets(); };
  return keep_factors(tip, tip.model->solve(loads));
}

Sifs Tips::keep_factors(Tip& tip, const FineSolution& solution) const {
  const Sifs sifs = factors_of(tip, solution);
  tip.kept_factors = {surroundings_->version(), sifs, tip.now.sif_error};
  return sifs;
}

Sifs Tips::factors_of(Tip& tip, const FineSolution& solution) const {
  for (const TipIntensities& found : solution.tips) {
    if (found.crack != tip.domain.crack || found.is_last != tip.domain.is_last) continue;
    tip.now.sif_error = found.error.norm();
    const Point k = options_.factors == "interaction_integral" ? found.K : found.K_correlation;
    return {k[0], k[1], found.T};
  }
  throw std::logic_error("the fine level has lost its tip");
}

double Tips::load(const Sifs& sifs) const {
  return options_.toughness ? equivalent_sif(sifs) / *options_.toughness : 0;
}

double Tips::estimated_load(const Tip& tip) const {
  // Williams' field: the jump at a distance r behind the tip is (8/E') sqrt(r/(2 pi)) K.
  const LameParameters lame = surroundings_->stiffness(position(tip, {}));
  const double distance = 0.5 * end_cell(mesh_, tip.end).measure;
  const double estimate = Elasticity{lame.lambda, lame.shear}.plane_modulus() / 8 *
                          std::sqrt(2 * std::numbers::pi / distance) *
                          surroundings_->jump_at_tip(tip.end.fracture, tip.end.at_end);
  constexpr double shear_to_equivalent = 1.25;
  return shear_to_equivalent * estimate / *options_.toughness;
}

Growing::Load Tips::examine(const StepTime& step) {
  surroundings_->update();
  for (Tip& tip : tips_) tip.now.speed = tip.now.advance / step.dt;
  notes_.clear();
  constexpr double safety = 2;  // of the estimate
  const bool may_rule_out = options_.toughness && options_.skip_below > 0;
  Load loads;
  const std::vector<TipPath> paths = paths_now();
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    Tip& tip = tips_[i];
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
    // At the end of an increment the load is 1 to within a tolerance, and the tip should not grow again for that.
    if (is_followed(tip)) continue;
    const double rest = options_.growth.seeks_arrest() ? options_.growth.arrest_tolerance : 0;
    loads.now = std::max(loads.now, tip.now.load / (1 + rest));
    loads.accepted = std::max(loads.accepted, tip.accepted.load / (1 + rest));
    if (tip.now.has_started) continue;
    loads.onset = std::max(loads.onset, tip.now.load);
    loads.onset_accepted = std::max(loads.onset_accepted, tip.accepted.load);
  }
  return loads;
}

void Tips::set_factors(Tip& tip, const Sifs& sifs) const {
  tip.now.sifs = sifs;
  tip.now.load = load(sifs);
  tip.now.is_evaluated = true;
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

double Tips::longest_path(const Tip& tip) const {
  return std::max(surroundings_->propagation_threshold() * tip.coarse_size, options_.growth.increment);
}

bool Tips::is_long_enough(const Tip& tip, const TipPath& path) const {
  // Whole increments may fall short of the threshold by what their last one was shortened.
  constexpr double nearly = 0.95;
  return length_of(position(tip, {}), path) >= nearly * surroundings_->propagation_threshold() * tip.coarse_size;
}

Growing::Growth Tips::grow(const StepTime&) {
  std::vector<GrowingTip> growing;
  for (const Tip& tip : tips_) {
    const LameParameters lame = surroundings_->stiffness(position(tip, {}));
    // A tip that the mesh follows has its own search; here it stays.
    const double toughness = is_followed(tip) ? std::numeric_limits<double>::max() : *options_.toughness;
    growing.push_back({position(tip, {}), direction(tip), toughness,
                       Elasticity{lame.lambda, lame.shear}.plane_modulus(), tip.now.path, tip.now.warm_start});
  }
  GrowthOptions growth = options_.growth;
  // Longer growth needs a new solution of the coarse level: the pressure of the fluid falls as tips grow.
  if (!growth.longest)
    for (const Tip& tip : tips_) growth.longest = std::max(growth.longest.value_or(0), longest_path(tip));
  const std::vector<TipOutcome> outcomes = grow_tips(
      growing, growth, [this](int tip, const std::vector<TipPath>& paths) { return evaluate(tip, paths); },
      [this](int tip, const TipPath& path, const Point& to) {
        return tips_[tip].now.is_stopped ? 0 : free_distance(tips_[tip], path, to);
      },
      [this](int tip, int other) { return is_near(tips_[tip], tips_[other]); });
  Growth result;
  std::vector<PathExtension>& extensions = result.extensions;
  std::vector<std::pair<int, int>> joined;
  std::vector<std::size_t> blocked, ended, met;
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    Tip& tip = tips_[i];
    if (is_followed(tip)) continue;
    tip.now.has_started = tip.now.has_started || tip.now.load >= 1;
    const TipOutcome& outcome = outcomes[i];
    increments_ += outcome.increments;
    const bool was_stopped = tip.now.is_stopped;
    tip.now.is_stopped = was_stopped || outcome.blocked;
    if (outcome.increments > 0) {
      tip.now.path = outcome.path;
      set_factors(tip, outcome.end);
    }
    if (!was_stopped) ended.push_back(i);
    tip.now.warm_start = outcome.warm_start;
    if (outcome.blocked && options_.meeting == "join") blocked.push_back(i);
    if (outcome.increments == 0) continue;
    result.arrested = result.arrested && (outcome.arrested || outcome.blocked);
    if (!is_long_enough(tip, tip.now.path)) continue;
    extensions.push_back({tip.end.fracture, tip.end.at_end, coarse_path(tip, tip.now.path)});
  }
  stop_refused(extensions, outcomes);
  // Last, when the paths of all other tips are known. A path that joins another fracture replaces the tip's former
  // path.
  for (const std::size_t i : blocked) {
    Tip& tip = tips_[i];
    std::vector<PathExtension> others;
    for (const PathExtension& other : extensions)
      if (!is_same({other.fracture, other.at_end}, tip.end)) others.push_back(other);
    const std::optional<Joining> joining = find_joining(tip, outcomes[i], others, joined);
    if (!joining) continue;
    tip.now.path.added.push_back(joining->extension.points.back());
    joined.emplace_back(tip.end.fracture, joining->other);
    extensions = std::move(others);
    extensions.push_back(joining->extension);
    met.push_back(i);
  }
  for (const std::size_t i : ended) note_end(tips_[i], outcomes[i], std::ranges::count(met, i) > 0);
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
  return {options_.cavity * size, size, options_.cavity_growth};
}

void Tips::accepted() {
  for (Tip& tip : tips_) {
    tip.accepted = tip.now;
    tip.now.advance = tip.accepted.advance = 0;
    // The next step starts with a triangulation that follows from the geometry alone, as after a restart.
    if (tip.has_pattern) {
      tip.model.reset();
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
  }
  notes_.clear();
}

void Tips::carry_over(const Part& before, const MeshChange& change) {
  const auto& old = dynamic_cast<const Tips&>(before);
  for (Tip& tip : tips_)
    for (const Tip& same : old.tips_) {
      if (!is_same(same.end, tip.end)) continue;
      tip.now = same.now;
      tip.pattern = same.pattern;
      // Only now: if the path were dropped when it is passed on, a mesh that cannot take it would lose it.
      const double taken = new_length(mesh_, tip.end, change) - given_up_length(mesh_, tip.end, change);
      if (taken > 0) {
        tip.now.grown += taken;
        tip.now.advance = taken;
        tip.now.is_extendable = grows_within_steps_;
        tip.now.path.added.clear();
      }
      tip.accepted = tip.now;
    }
  for (Joint& joint : joints_) {
    for (const Joint& same : old.joints_)
      if (is_same(same.end, joint.end)) joint.grown = same.grown;
    for (const Tip& same : old.tips_)
      if (is_same(same.end, joint.end)) joint.grown = same.now.grown + new_length(mesh_, joint.end, change);
  }
}

void Tips::report(std::vector<Quantity>& quantities) const {
  // In the order of ends, so that columns stay when a tip joins a fracture and is none any more.
  for (const TipEnd& end : all_ends(mesh_)) {
    for (const Tip& tip : tips_)
      if (is_same(tip.end, end))
        report_end(tip.name, tip.now, tip.now.grown + length_of(position(tip, {}), tip.now.path), quantities);
    State at_rest;
    at_rest.is_stopped = true;
    for (const Joint& joint : joints_)
      if (is_same(joint.end, end)) report_end(joint.name, at_rest, joint.grown, quantities);
  }
}

void Tips::report_end(const std::string& end, const State& state, double length,
                      std::vector<Quantity>& quantities) const {
  const std::string prefix = name() + "." + end + ".";
  const auto known = [&state](double value) {
    return state.is_evaluated ? value : std::numeric_limits<double>::quiet_NaN();
  };
  quantities.push_back({prefix + "K_I", "Pa*m^0.5", known(state.sifs.k1)});
  quantities.push_back({prefix + "K_II", "Pa*m^0.5", known(state.sifs.k2)});
  quantities.push_back({prefix + "K_eq", "Pa*m^0.5", known(equivalent_sif(state.sifs))});
  quantities.push_back({prefix + "K_error_fine_mesh", "Pa*m^0.5", known(state.sif_error)});
  quantities.push_back({prefix + "stopped", "1", state.is_stopped ? 1.0 : 0.0});
  quantities.push_back({prefix + "length", "m", length});
}

std::map<std::string, long> Tips::counts() const {
  return {{"tips: solves", solves_},
          {"tips: meshes", meshes_},
          {"tips: answers kept", kept_},
          {"tips: ruled out", skipped_},
          {"tips: increments", increments_}};
}

std::vector<Profile::Entry> Tips::efforts() const {
  std::vector<Profile::Entry> efforts(profile_->entries().begin(), profile_->entries().end());
  for (Profile::Entry& effort : efforts) effort.name = "tips: " + effort.name;
  return efforts;
}

namespace {

const RegisterComponent<Tips, TipsOptions> registration("fine_fracture/quarter_point");

}  // namespace

}  // namespace sprekk::fine_fracture
