#include "framework/discretization/end_zones.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "framework/discretization/end_frame.hpp"
#include "framework/discretization/end_surroundings.hpp"
#include "framework/discretization/ends_nearby.hpp"
#include "framework/invariants.hpp"

namespace sprekk {
namespace {

/// Falls smoothly from 1 at 1 - width to 0 at 1.
double fading(double part, double width) {
  const double s = std::clamp((1 - part) / width, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// Nodes of sides and fractures, which disturb the field of an end.
std::vector<int> outer_nodes(const Mesh& mesh) {
  std::set<int> nodes;
  for (int face = 0; face < mesh.face_count(); ++face)
    if (mesh.face_cells[face][1] == none) nodes.insert(mesh.face_nodes[face].begin(), mesh.face_nodes[face].end());
  return {nodes.begin(), nodes.end()};
}

/// How far from an end its field is undisturbed.
struct Room {
  double free = std::numeric_limits<double>::infinity();       ///< m, to what disturbs it
  double other_tip = std::numeric_limits<double>::infinity();  ///< m, to the tip at the other end of its fracture
};

Room room_around(const Mesh& mesh, int end, const std::vector<int>& outer, const ZoneLimits& limits) {
  const EndFrame frame(mesh, end);
  SPREKK_ASSERT(is_fracture_end(mesh, end), end);
  const FractureCell& last = mesh.fracture_cells[NodeWalls(mesh, end).cells[0]];
  struct Place {
    double distance, off_line;  ///< m, and the distance from the line of the end over that from the end
  };
  std::vector<Place> on_own_fracture;
  Room room;
  for (const int node : outer) {
    if (node == end) continue;
    const Point from_end = mesh.nodes[node] - mesh.nodes[end];
    const double distance = from_end.norm();
    if (distance >= room.free) continue;
    if (!is_field_undisturbed(mesh, node, last)) {
      room.free = std::min(room.free, distance);
      continue;
    }
    on_own_fracture.push_back({distance, std::abs(frame.axes().col(1).dot(from_end)) / distance});
    if (is_fracture_end(mesh, node)) room.other_tip = std::min(room.other_tip, distance);
  }
  constexpr double beyond = 1.25;  // a zone as long as this without bends is limited by other things alone
  const double without_bends = beyond * std::min(room.free, room.other_tip);
  for (const auto& [distance, off_line] : on_own_fracture)
    if (distance < without_bends) {
      const double straight = std::max(0.0, 1 - off_line / limits.off_line);
      room.free = std::min(room.free, distance + straight * (without_bends - distance));
    }
  return room;
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
    const double radius = local.norm();
    return std::min(fading(2 * radius / room.free, limits.fading_part),
                    fading(2 * radius / room.other_tip, limits.joining_part)) *
           fading(from_fracture / (limits.half_width * frame.size()), limits.fading_part);
  };
  std::vector<Reached> reached{{end, 1}};
  std::set<int> seen{end};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const int face : mesh.node_faces[reached[i].node])
      for (const int node : mesh.face_nodes[face])
        if (const double w = weight(node); w > 0 && seen.insert(node).second && is_field_undisturbed(mesh, node, last))
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
  const std::vector<int> outer = outer_nodes(mesh);
  for (int node = 0; node < mesh.node_count(); ++node)
    if (zones.end[node] != none) zones.weight[node] = 1;
  for (int end = 0; end < mesh.node_count(); ++end) {
    if (!is_fracture_end(mesh, end)) continue;
    zones.cells[end] = cells_next_to(mesh, end);
    for (const auto& [node, weight] : nodes_of_zone(mesh, end, room_around(mesh, end, outer, limits), limits)) {
      if (zones.end[node] != none) continue;
      zones.end[node] = end;
      SPREKK_ASSERT(weight > 0 && weight <= 1, node, weight);
      zones.weight[node] = weight;
    }
  }
  return zones;
}

}  // namespace sprekk
