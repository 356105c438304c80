#include "components/fine_fracture/quarter_point/mesh/moved_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "framework/mesh/plane/planar.hpp"

namespace sprekk::fine_fracture {
namespace {

bool has_same_topology(const Triangulated& made, const FineGeometry& geometry, const std::vector<TipRoom>& rooms) {
  const auto same_crack = [](const CrackPath& a, const CrackPath& b) {
    return a.points.size() == b.points.size() && a.walls == b.walls && a.first_is_tip == b.first_is_tip &&
           a.last_is_tip == b.last_is_tip;
  };
  const auto same_room = [](const TipRoom& a, const TipRoom& b) {
    return a.crack == b.crack && a.is_last == b.is_last;
  };
  return made.geometry.outline.size() == geometry.outline.size() && made.geometry.sides == geometry.sides &&
         std::ranges::equal(made.geometry.cracks, geometry.cracks, same_crack) &&
         std::ranges::equal(made.rooms, rooms, same_room);
}

/// A point on a segment, moved along with its ends.
Point carried(const Point& x, const Segment& from, const Segment& to) {
  const Point along = from.to - from.from;
  const double part = std::clamp((x - from.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return to.from + part * (to.to - to.from);
}

Segment segment_of(const CrackPath& crack, std::size_t i) { return {crack.points[i], crack.points[i + 1]}; }

Segment edge_of(const std::vector<Point>& outline, std::size_t i) {
  return {outline[i], outline[(i + 1) % outline.size()]};
}

/// The segment of a path that is nearest to a point on it.
std::size_t nearest_segment(const CrackPath& crack, const Point& x) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < crack.points.size(); ++i) {
    const double away = distance(x, segment_of(crack, i));
    if (away < least) least = away, nearest = i;
  }
  return nearest;
}

double smallest_angle(const std::vector<Point>& nodes, const std::vector<Ring>& cells) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Ring& cell : cells)
    for (int k = 0; k < 3; ++k) {
      const Point a = nodes[cell[(k + 1) % 3]] - nodes[cell[k]], b = nodes[cell[(k + 2) % 3]] - nodes[cell[k]];
      smallest = std::min(smallest, std::atan2(cross(a, b), a.dot(b)));
    }
  return smallest;
}

std::shared_ptr<const Triangulated::Followers> followers(const RawMesh& raw, const std::map<int, Point>& places) {
  std::set<std::array<int, 2>> edges;
  for (const Ring& cell : raw.cells)
    for (int k = 0; k < 3; ++k)
      edges.insert({std::min(cell[k], cell[(k + 1) % 3]), std::max(cell[k], cell[(k + 1) % 3])});
  std::vector<int> moved;
  for (const auto& [node, place] : places) moved.push_back(node);
  return std::shared_ptr<const Triangulated::Followers>(
      new Triangulated::Followers{{raw.nodes, {edges.begin(), edges.end()}, std::vector<bool>(raw.nodes.size()), moved},
                                  smallest_angle(raw.nodes, raw.cells)});
}

}  // namespace

std::optional<OutsideMesh> moved_mesh(const Triangulated& made, const FineGeometry& geometry,
                                      const std::vector<TipRoom>& rooms) {
  if (!has_same_topology(made, geometry, rooms)) return std::nullopt;
  const RawMesh& raw = made.mesh.raw;
  // Later entries hold: an end of a crack on the outline follows the crack, and rosettes move as a whole.
  std::map<int, Point> places;
  for (const RawMesh::BoundaryFace& edge : raw.boundary_faces)
    for (const int node : edge.nodes)
      places[node] =
          carried(raw.nodes[node], edge_of(made.geometry.outline, edge.side), edge_of(geometry.outline, edge.side));
  for (std::size_t c = 0; c < geometry.cracks.size(); ++c)
    for (const int node : raw.fractures[c].nodes) {
      const std::size_t i = nearest_segment(made.geometry.cracks[c], raw.nodes[node]);
      places[node] =
          carried(raw.nodes[node], segment_of(made.geometry.cracks[c], i), segment_of(geometry.cracks[c], i));
    }
  for (std::size_t t = 0; t < rooms.size(); ++t) {
    const TipRoom &from = made.rooms[t], &to = rooms[t];
    const double scale = to.radius / from.radius, c = scale * from.direction.dot(to.direction),
                 s = scale * cross(from.direction, to.direction);
    for (const int node : made.mesh.rosettes[t]) {
      const Point away = raw.nodes[node] - from.position;
      places[node] = to.position + Point(c * away[0] - s * away[1], s * away[0] + c * away[1]);
    }
    const std::vector<int>& chain = raw.fractures[to.crack].nodes;
    places[to.is_last ? chain.back() : chain.front()] = to.position;
  }
  std::vector<MovedNode> moved;
  for (const auto& [node, place] : places) moved.push_back({node, made.frame.inward(place) - raw.nodes[node]});
  if (!made.followers) made.followers = followers(raw, places);
  const std::vector<Point> motion = made.followers->motion.of(moved);
  OutsideMesh result = made.mesh;
  for (std::size_t i = 0; i < motion.size(); ++i) result.raw.nodes[i] = made.frame.outward(raw.nodes[i] + motion[i]);
  for (const auto& [node, place] : places) result.raw.nodes[node] = place;
  constexpr double least = 0.5;  // of the smallest angle: below, a new one is better
  if (!(smallest_angle(result.raw.nodes, raw.cells) > least * made.followers->smallest_angle)) return std::nullopt;
  return result;
}

}  // namespace sprekk::fine_fracture
