#include "components/fine_fracture/tips/tips.hpp"

#include <algorithm>

#include "components/fine_fracture/tips/ends.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/mesh/topology_hash.hpp"

namespace sprekk::fine_fracture {

Tips::Tips(const ComponentContext& context, const TipsOptions& options, std::unique_ptr<const FineLevelMaker> maker)
    : Component(context.name),
      mesh_(context.mesh),
      origin_(context.origin),
      options_(options),
      maker_(std::move(maker)) {
  check_increment();
  check_anisotropy();
  check_longest();
  for (const TipEnd& end : all_ends(mesh_)) {
    if (kind_of(mesh_, end) == Ridge::Kind::junction) joints_.push_back({end, name_of(mesh_, end)});
    if (kind_of(mesh_, end) != Ridge::Kind::tip) continue;
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

const FractureCell& Tips::last_cell(const TipEnd& end) const { return end_cell(mesh_, end); }

Point Tips::position(const Tip& tip, const TipPath& path) const {
  if (!path.added.empty()) return path.added.back();
  return end_point(mesh_, tip.end);
}

Point Tips::direction(const Tip& tip) const {
  const Point& tangent = end_cell(mesh_, tip.end).tangents;
  return tip.end.at_end ? tangent : Point(-tangent);
}

std::optional<Point> Tips::corner_of_last_segment(const Tip& tip) const {
  if (!tip.now.segment_start) return std::nullopt;
  const Point end = position(tip, {});
  return corner_of_arc(end - last_cell(tip.end).measure * direction(tip), *tip.now.segment_start, end);
}

Point Tips::end_direction(const Tip& tip) const {
  const std::optional<Point> corner = corner_of_last_segment(tip);
  return corner ? Point((position(tip, {}) - *corner).normalized()) : direction(tip);
}

double Tips::ahead(const Tip& tip, const TipPath& path) const {
  const std::vector<Point>& added = path.added;
  const Point way = added.empty()       ? end_direction(tip)
                    : added.size() == 1 ? Point(added[0] - position(tip, {}))
                                        : Point(added.back() - added[added.size() - 2]);
  return std::atan2(way[1], way[0]);
}

BesideArcs Tips::arcs_of_last_segments() const {
  BesideArcs arcs;
  if (maker_->has_offsets_on_walls()) return arcs;
  for (const Tip& tip : tips_)
    if (const std::optional<Point> corner = corner_of_last_segment(tip)) {
      const Point end = position(tip, {});
      arcs.add(end - last_cell(tip.end).measure * direction(tip), *corner, end);
    }
  return arcs;
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
    segments[end] = {tips_[i].now.is_extendable, corner_of_last_segment(tips_[i])};
  }
  std::vector<FracturePath> paths;
  for (int f = 0; f < static_cast<int>(mesh_.fractures.size()); ++f)
    paths.push_back(fracture_path(mesh_, f, *of_end[2 * f], *of_end[2 * f + 1], segments[2 * f], segments[2 * f + 1]));
  return paths;
}

CavityOptions Tips::cavity() const {
  double size = 0;
  for (const Tip& tip : tips_) size = std::max(size, tip.coarse_size);
  return {.radius = options_.cavity * size, .size = size, .growth = options_.cavity_growth, .rounds = true};
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
