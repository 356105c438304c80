// How a tip joins another fracture.
#include <cmath>
#include <numbers>

#include "components/fine_fracture/quarter_point/tips.hpp"
#include "framework/mesh/fracture_networks.hpp"

namespace sprekk::fine_fracture {

std::optional<Tips::Joining> Tips::find_joining(const Tip& tip, const TipOutcome& outcome,
                                                std::vector<PathExtension> extensions,
                                                const std::vector<std::pair<int, int>>& joined) const {
  const Point from = position(tip, tip.now.path);
  const sprekk::FreeLength free = sprekk::free_length(mesh_, tip.end.fracture, tip.end.at_end, from, outcome.ahead);
  const double reach = 2 * cavity().size;
  const bool is_ahead = free.met == sprekk::FreeLength::Met::fracture && free.length < reach;
  // Where another fracture passes by, the nearest point that is not behind.
  const Point wanted = is_ahead ? free.where : from;
  constexpr double widest_turn = std::numbers::pi / 3;
  const std::vector<int> networks = fracture_networks(mesh_, joined);
  const auto fracture_of = [&](const FracturePoint& point) { return mesh_.fracture_cells[point.cells[0]].fracture; };
  const FracturePoint* nearest = nullptr;
  for (const FracturePoint& point : mesh_.fracture_points) {
    const Point way = point.position - from;
    if (networks[fracture_of(point)] == networks[tip.end.fracture] || way.norm() > reach ||
        way.dot(outcome.ahead) < std::cos(widest_turn) * way.norm())
      continue;
    if (!nearest || (point.position - wanted).norm() < (nearest->position - wanted).norm()) nearest = &point;
  }
  if (!nearest) return std::nullopt;
  TipPath path = tip.now.path;
  path.added.push_back(nearest->position);
  const PathExtension extension{tip.end.fracture, tip.end.at_end, coarse_path(tip, path)};
  extensions.push_back(extension);
  try {
    check_extensions(mesh_, extensions, cavity().size);
  } catch (const ExtensionError&) {
    return std::nullopt;  // the tip stays where it is
  }
  return Joining{extension, fracture_of(*nearest)};
}

}  // namespace sprekk::fine_fracture
