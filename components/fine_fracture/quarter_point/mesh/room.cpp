#include "components/fine_fracture/quarter_point/mesh/room.hpp"

#include <algorithm>
#include <limits>

#include "components/fine_fracture/fine_level/outline.hpp"
#include "framework/round_off.hpp"

namespace sprekk::fine_fracture {
namespace {

/// The points of a path in their order from a tip.
struct Walk {
  std::vector<Point> points;
  std::vector<CrackPath::Walls> walls;
  bool ends_in_tip;
};

Walk walk_from(const CrackPath& crack, bool from_last) {
  Walk walk{crack.points, crack.walls, from_last ? crack.first_is_tip : crack.last_is_tip};
  if (from_last) {
    std::reverse(walk.points.begin(), walk.points.end());
    std::reverse(walk.walls.begin(), walk.walls.end());
  }
  return walk;
}

TipRoom room_of(const FineGeometry& geometry, int c, bool is_last, double largest_radius, StraightPoints points) {
  const Walk walk = walk_from(geometry.cracks[c], is_last);
  const Point tip = walk.points[0];
  const Point along = (walk.points[1] - tip).normalized();
  TipRoom room{c, is_last, tip, -along, 0, 0, 0, 0};

  std::size_t segments = 0;  // segments of the straight end
  while (segments < walk.walls.size()) {
    const Point step = (walk.points[segments + 1] - walk.points[segments]).normalized();
    if (std::abs(cross(along, step)) > rounding::same || along.dot(step) < 0) break;
    if (segments > 0 && points == StraightPoints::end_it && walk.walls[segments] == walk.walls[segments - 1]) break;
    ++segments;
    room.straight = (walk.points[segments] - tip).norm();
    if (std::all_of(walk.walls.begin(), walk.walls.begin() + segments, [&](auto w) { return w == walk.walls[0]; })) {
      room.same_walls = room.straight;
    }
  }
  const bool has_two_tips = segments == walk.walls.size() && walk.ends_in_tip;

  room.clearance = depth_inside(tip, geometry.outline);
  for (std::size_t i = segments; i < walk.walls.size(); ++i) {
    room.clearance = std::min(room.clearance, distance(tip, Segment{walk.points[i], walk.points[i + 1]}));
  }
  double to_others = std::numeric_limits<double>::infinity();
  for (std::size_t other = 0; other < geometry.cracks.size(); ++other) {
    const auto& points = geometry.cracks[other].points;
    if (static_cast<int>(other) == c) continue;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      to_others = std::min(to_others, distance(tip, Segment{points[i], points[i + 1]}));
    }
  }
  // Radii of a third of the distance between two tips leave a third of it between their rosettes.
  room.radius = std::min(
      {largest_radius, room.straight / (has_two_tips ? 3 : 2), room.same_walls / 2, room.clearance / 2, to_others / 3});
  if (walk.ends_in_tip) room.radius = std::min(room.radius, (walk.points.back() - tip).norm() / 3);
  room.clearance = std::min(room.clearance, to_others);
  if (has_two_tips) room.clearance = std::min(room.clearance, room.straight - room.radius);
  return room;
}

}  // namespace

std::vector<TipRoom> tip_rooms(const FineGeometry& geometry, double largest_radius, StraightPoints points) {
  std::vector<TipRoom> rooms;
  const auto add = [&](std::size_t crack, bool is_last) {
    rooms.push_back(room_of(geometry, static_cast<int>(crack), is_last, largest_radius, points));
  };
  for (std::size_t c = 0; c < geometry.cracks.size(); ++c) {
    if (geometry.cracks[c].first_is_tip) add(c, false);
    if (geometry.cracks[c].last_is_tip) add(c, true);
  }
  // The clearance also excludes the rosettes of other tips.
  for (TipRoom& room : rooms)
    for (const TipRoom& other : rooms)
      if (&other != &room)
        room.clearance = std::min(room.clearance, (other.position - room.position).norm() - other.radius);
  return rooms;
}

}  // namespace sprekk::fine_fracture
