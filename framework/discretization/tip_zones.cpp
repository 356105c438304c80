#include "framework/discretization/tip_zones.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "framework/discretization/tip_frame.hpp"
#include "framework/discretization/tip_surroundings.hpp"
#include "framework/discretization/tips_nearby.hpp"
#include "framework/invariants.hpp"

namespace sprekk {
namespace {

/// Largest ratio of a node's distance from the line of the tip to that from the tip for a fracture that keeps its line.
constexpr double off_line = 1e-3;

/// Half of the width of a zone along the fracture, in lengths of the cell at the tip.
constexpr double half_width = 8;

/// Of the way, where the correction fades out; and where the zone of the fracture's other tip goes on.
constexpr double fading_part = 0.1, joining_part = 0.01;

/// Falls smoothly from 1 at 1 - width to 0 at 1.
double fading(double part, double width) {
  const double s = std::clamp((1 - part) / width, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// Nodes of sides and fractures, which disturb the field of a tip.
std::vector<int> outer_nodes(const Mesh& mesh) {
  std::set<int> nodes;
  for (int face = 0; face < mesh.face_count(); ++face)
    if (mesh.face_cells[face][1] == none) nodes.insert(mesh.face_nodes[face].begin(), mesh.face_nodes[face].end());
  return {nodes.begin(), nodes.end()};
}

/// What is nearest in the way of a tip's field.
struct Obstacle {
  double distance = std::numeric_limits<double>::infinity();  ///< m
  bool is_other_tip = false;                                  ///< of the fracture, which is straight
};

Obstacle nearest_obstacle(const Mesh& mesh, int tip, const std::vector<int>& outer) {
  const TipFrame frame(mesh, tip);
  SPREKK_ASSERT(is_tip(mesh, tip), tip);
  const FractureCell& last = mesh.fracture_cells[NodeWalls(mesh, tip).cells[0]];
  Obstacle nearest;
  for (const int node : outer) {
    if (node == tip) continue;
    const Point from_tip = mesh.nodes[node] - mesh.nodes[tip];
    if (from_tip.squaredNorm() >= nearest.distance * nearest.distance) continue;
    const bool is_on_line = std::abs(frame.axes().col(1).dot(from_tip)) <= off_line * from_tip.norm();
    const bool ends = is_tip(mesh, node), goes_on = is_on_line && tip_field_goes_on(mesh, node, last);
    if (ends || !goes_on) nearest = {from_tip.norm(), ends && goes_on};
  }
  return nearest;
}

struct Reached {
  int node;
  double weight;
};

/// The nodes of a zone that ends half of the way to an obstacle, reached along nodes where the field goes on.
std::vector<Reached> nodes_of_zone(const Mesh& mesh, int tip, const Obstacle& obstacle) {
  const double radius = 0.5 * obstacle.distance, width = obstacle.is_other_tip ? joining_part : fading_part;
  const TipFrame frame(mesh, tip);
  const FractureCell& last = mesh.fracture_cells[NodeWalls(mesh, tip).cells[0]];
  const auto weight = [&](int node) {
    const Point local = frame.axes().transpose() * (mesh.nodes[node] - mesh.nodes[tip]);
    const double from_fracture = local.x() < 0 ? std::abs(local.y()) : local.norm();
    return fading(local.norm() / radius, width) * fading(from_fracture / (half_width * frame.size()), fading_part);
  };
  std::vector<Reached> reached{{tip, 1}};
  std::set<int> seen{tip};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const int face : mesh.node_faces[reached[i].node])
      for (const int node : mesh.face_nodes[face])
        if (const double w = weight(node); w > 0 && seen.insert(node).second && tip_field_goes_on(mesh, node, last))
          reached.push_back({node, w});
  return reached;
}

std::vector<int> cells_next_to(const Mesh& mesh, int tip) {
  std::set<int> cells;
  for (const int node : nodes_around_tip(mesh, tip, 1))
    cells.insert(mesh.node_cells[node].begin(), mesh.node_cells[node].end());
  return {cells.begin(), cells.end()};
}

}  // namespace

TipZones tip_zones(const Mesh& mesh) {
  TipZones zones{tips_nearby(mesh), std::vector<double>(mesh.node_count(), 0), {}};
  const std::vector<int> outer = outer_nodes(mesh);
  for (int node = 0; node < mesh.node_count(); ++node)
    if (zones.tip[node] != none) zones.weight[node] = 1;
  for (int tip = 0; tip < mesh.node_count(); ++tip) {
    if (!is_tip(mesh, tip)) continue;
    zones.cells[tip] = cells_next_to(mesh, tip);
    for (const auto& [node, weight] : nodes_of_zone(mesh, tip, nearest_obstacle(mesh, tip, outer))) {
      if (zones.tip[node] != none) continue;
      zones.tip[node] = tip;
      SPREKK_ASSERT(weight > 0 && weight <= 1, node, weight);
      zones.weight[node] = weight;
    }
  }
  return zones;
}

}  // namespace sprekk
