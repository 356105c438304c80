// How a tip joins another fracture.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "components/fine_fracture/growth/coarse_path.hpp"
#include "components/fine_fracture/tips/tips.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/fracture_networks.hpp"
#include "framework/remeshing/free_length.hpp"

namespace sprekk::fine_fracture {

namespace {

double distance_to_boundary(const Mesh& mesh, const Point& x) {
  double least = std::numeric_limits<double>::infinity();
  for (int face = 0; face < mesh.face_count(); ++face)
    if (mesh.face_side[face] != none)
      least = std::min(
          least, distance(x, Segment{mesh.nodes[mesh.face_nodes[face][0]], mesh.nodes[mesh.face_nodes[face][1]]}));
  return least;
}

}  // namespace

/// Whether a point is a tip with a path that the mesh does not have yet: then the point is not the end of its fracture.
bool Tips::continues_elsewhere(const Ridge& point) const {
  return point.kind == Ridge::Kind::tip && std::any_of(tips_.begin(), tips_.end(), [&](const Tip& tip) {
           return !tip.now.path.added.empty() && position(tip, {}) == point.center;
         });
}

std::optional<Tips::Joining> Tips::find_joining(const Tip& tip, const TipOutcome& outcome,
                                                const std::vector<PathExtension>& others,
                                                const std::vector<std::pair<int, int>>& joined) const {
  using Met = sprekk::FreeLength::Met;
  const Point from = position(tip, tip.now.path);
  const std::vector<int> networks = fracture_networks(mesh_, joined);
  const int own = networks[tip.end.fracture];
  const sprekk::FreeLength free = sprekk::free_length(mesh_, tip.end.fracture, tip.end.at_end, from, outcome.ahead);
  const double reach = 2 * cavity().size;
  const bool is_met = free.met != Met::nothing && free.length < reach;
  // The tip cannot join a side, nor a fracture that it is connected with.
  if (is_met && (free.met == Met::boundary || networks[free.index] == own)) return std::nullopt;
  // Where another fracture passes by, its nearest point that is not behind the tip is wanted.
  const Point wanted = is_met ? free.where : from;
  const double to_side = is_met ? reach : distance_to_boundary(mesh_, from);
  // 60 degrees, between the direction of a tip and the way to the other fracture.
  constexpr double widest_turn = std::numbers::pi / 3;
  std::vector<std::pair<double, const Ridge*>> candidates;
  for (const Ridge& point : mesh_.ridges) {
    const Point way = point.center - from;
    if (networks[mesh_.fracture_cells[point.cells[0]].fracture] == own || point.kind == Ridge::Kind::on_boundary ||
        continues_elsewhere(point) || way.norm() > std::min(reach, to_side) ||
        way.dot(outcome.ahead) < std::cos(widest_turn) * way.norm())
      continue;
    candidates.emplace_back((point.center - wanted).norm(), &point);
  }
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [away, point] : candidates) {
    TipPath path = tip.now.path;
    path.added.push_back(point->center);
    const PathExtension extension{tip.end.fracture, tip.end.at_end,
                                  coarse_path(position(tip, {}), path.added, tip.coarse_size, SharpBends::are_dropped)};
    std::vector<PathExtension> all = others;
    all.push_back(extension);
    try {
      check_extensions(mesh_, all, cavity().size);
    } catch (const ExtensionError&) {
      continue;
    }
    return Joining{extension, mesh_.fracture_cells[point->cells[0]].fracture};
  }
  return std::nullopt;  // the tip stays where it is
}

}  // namespace sprekk::fine_fracture
