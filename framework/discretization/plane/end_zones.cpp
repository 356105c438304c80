#include "framework/discretization/plane/end_zones.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "framework/discretization/end_frame.hpp"
#include "framework/discretization/ends_nearby.hpp"
#include "framework/discretization/plane/end_surroundings.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/search/plane/segment_tree.hpp"

namespace sprekk {
namespace {

/// Falls smoothly from 1 at 1 - width to 0 at 1.
double fading(double part, double width) {
  const double s = std::clamp((1 - part) / width, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// The nodes of sides and fractures, which disturb the field of an end.
class OuterNodes {
 public:
  explicit OuterNodes(const Mesh& mesh) : nodes_(nodes_of(mesh)), tree_(places_of(mesh, nodes_)) {}

  std::size_t count() const { return nodes_.size(); }
  /// All that are not farther than `reach` (m), and some that are, in ascending order.
  std::vector<int> near(const Point& x, double reach) const {
    std::vector<int> near = tree_.near({x, x}, reach);
    for (int& node : near) node = nodes_[node];
    return near;
  }

 private:
  static std::vector<int> nodes_of(const Mesh& mesh) {
    std::set<int> nodes;
    for (int face = 0; face < mesh.face_count(); ++face)
      if (mesh.face_cells[face][1] == none) nodes.insert(mesh.face_nodes[face].begin(), mesh.face_nodes[face].end());
    return {nodes.begin(), nodes.end()};
  }
  static std::vector<Segment> places_of(const Mesh& mesh, const std::vector<int>& nodes) {
    std::vector<Segment> places;
    for (const int node : nodes) places.push_back({mesh.nodes[node], mesh.nodes[node]});
    return places;
  }

  std::vector<int> nodes_;
  SegmentTree tree_;
};

/// A place on the end's own fracture.
struct Bend {
  double distance;  ///< m, from the end
  double straight;  ///< 1 on the line of the end, and smoothly less down to 0 where the fracture has left it
};

/// How far from an end its field is undisturbed.
struct Room {
  double free = std::numeric_limits<double>::infinity();       ///< m, to what disturbs it
  double other_tip = std::numeric_limits<double>::infinity();  ///< m, to the tip at the other end of its fracture
  std::vector<Bend> bends;

  /// How much of the field counts at this distance (m).
  double weight(double radius, const ZoneLimits& limits) const {
    double weight =
        std::min(fading(2 * radius / free, limits.fading_part), fading(2 * radius / other_tip, limits.joining_part));
    for (const auto& [distance, straight] : bends)
      weight = std::min(weight, straight + (1 - straight) * fading(2 * radius / distance, limits.fading_part));
    return weight;
  }
};

/// What is seen of the room from these nodes of sides and fractures.
Room room_among(const std::vector<int>& outer, const Mesh& mesh, int end, const EndFrame& frame,
                const ZoneLimits& limits) {
  SPREKK_ASSERT(is_fracture_end(mesh, end), end);
  const FractureCell& last = mesh.fracture_cells[NodeWalls(mesh, end).cells[0]];
  Room room;
  for (const int node : outer) {
    if (node == end) continue;
    const Point from_end = mesh.nodes[node] - mesh.nodes[end];
    const double distance = from_end.norm();
    if (distance >= room.free) continue;  // the field has faded out where a bend there would begin to count
    if (!is_field_undisturbed(mesh, node, last)) {
      room.free = std::min(room.free, distance);
      continue;
    }
    const double off_line = std::abs(frame.axes().col(1).dot(from_end)) / distance;
    room.bends.push_back({distance, fading(off_line / limits.off_line, 1)});
    if (is_fracture_end(mesh, node)) room.other_tip = std::min(room.other_tip, distance);
  }
  return room;
}

/// Looks farther and farther away until something disturbs the field. Adds the nodes that were looked at.
Room room_around(const Mesh& mesh, int end, const OuterNodes& outer, const ZoneLimits& limits, long& looked_at) {
  const EndFrame frame(mesh, end);
  for (double reach = limits.half_width * frame.size();; reach *= 2) {
    const std::vector<int> near = outer.near(mesh.nodes[end], reach);
    looked_at += static_cast<long>(near.size());
    Room room = room_among(near, mesh, end, frame, limits);
    if (room.free <= reach || near.size() == outer.count()) return room;
  }
}

struct Reached {
  int node;
  double weight;
};

/// The nodes of a zone that ends half of the way to what disturbs the field and to the fracture's other tip, as far as
/// they are connected along nodes with an undisturbed field.
std::vector<Reached> nodes_of_zone(const Mesh& mesh, int end, const Room& room, const ZoneLimits& limits) {
  const EndFrame frame(mesh, end);
  const FractureCell& last = mesh.fracture_cells[NodeWalls(mesh, end).cells[0]];
  const auto weight = [&](int node) {
    const Point local = frame.axes().transpose() * (mesh.nodes[node] - mesh.nodes[end]);
    const double from_fracture = local.x() < 0 ? std::abs(local.y()) : local.norm();
    return room.weight(local.norm(), limits) *
           fading(from_fracture / (limits.half_width * frame.size()), limits.fading_part);
  };
  std::vector<Reached> reached{{end, 1}};
  std::set<int> seen{end};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const int face : mesh.node_faces[reached[i].node])
      for (const int node : mesh.face_nodes[face])
        if (seen.insert(node).second)
          if (const double w = weight(node); w > 0 && is_field_undisturbed(mesh, node, last))
            reached.push_back({node, w});
  return reached;
}

std::vector<int> cells_next_to(const Mesh& mesh, int end) {
  std::set<int> cells;
  for (const int node : nodes_around_end(mesh, end, 1))
    cells.insert(mesh.node_cells[node].begin(), mesh.node_cells[node].end());
  return {cells.begin(), cells.end()};
}

}  // namespace

EndZones end_zones(const Mesh& mesh, const ZoneLimits& limits) {
  EndZones zones{ends_nearby(mesh, limits.near), std::vector<double>(mesh.node_count(), 0), {}};
  const OuterNodes outer(mesh);
  for (int node = 0; node < mesh.node_count(); ++node)
    if (zones.end[node] != none) zones.weight[node] = 1;
  for (int end = 0; end < mesh.node_count(); ++end) {
    if (!is_fracture_end(mesh, end)) continue;
    zones.cells[end] = cells_next_to(mesh, end);
    const Room room = room_around(mesh, end, outer, limits, zones.looked_at);
    for (const auto& [node, weight] : nodes_of_zone(mesh, end, room, limits)) {
      if (zones.end[node] != none) continue;
      zones.end[node] = end;
      SPREKK_ASSERT(weight > 0 && weight <= 1, node, weight);
      zones.weight[node] = weight;
    }
  }
  return zones;
}

}  // namespace sprekk
