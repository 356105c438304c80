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

/// Falls smoothly from 1 at nine tenths of the way to 0 at its end.
double fading(double part) {
  const double s = std::clamp(10 * (1 - part), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// Nodes of sides and fractures, which disturb the field of a tip.
std::vector<int> outer_nodes(const Mesh& mesh) {
  std::set<int> nodes;
  for (int face = 0; face < mesh.face_count(); ++face)
    if (mesh.face_cells[face][1] == none) nodes.insert(mesh.face_nodes[face].begin(), mesh.face_nodes[face].end());
  return {nodes.begin(), nodes.end()};
}

/// The distance from a tip to the nearest node that disturbs its field, m.
double free_way(const Mesh& mesh, int tip, const std::vector<int>& outer) {
  const TipFrame frame(mesh, tip);
  const FractureCell& last = mesh.fracture_cells[NodeWalls(mesh, tip).cells[0]];
  SPREKK_ASSERT(is_tip(mesh, tip), tip);
  double way = std::numeric_limits<double>::infinity();
  for (const int node : outer) {
    if (node == tip) continue;
    const Point from_tip = mesh.nodes[node] - mesh.nodes[tip];
    if (from_tip.squaredNorm() >= way * way) continue;
    const bool is_on_line = std::abs(frame.axes().col(1).dot(from_tip)) <= off_line * from_tip.norm();
    if (!is_on_line || is_tip(mesh, node) || !tip_field_goes_on(mesh, node, last)) way = from_tip.norm();
  }
  return way;
}

struct Reached {
  int node;
  double weight;
};

/// The nodes of a zone that ends at the radius (m), reached along nodes where the field goes on.
std::vector<Reached> nodes_within(const Mesh& mesh, int tip, double radius) {
  SPREKK_EXPECT(radius > 0, tip, radius);
  const TipFrame frame(mesh, tip);
  const FractureCell& last = mesh.fracture_cells[NodeWalls(mesh, tip).cells[0]];
  const auto weight = [&](int node) {
    const Point local = frame.axes().transpose() * (mesh.nodes[node] - mesh.nodes[tip]);
    const double from_fracture = local.x() < 0 ? std::abs(local.y()) : local.norm();
    return fading(local.norm() / radius) * fading(from_fracture / (half_width * frame.size()));
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
    for (const auto& [node, weight] : nodes_within(mesh, tip, 0.5 * free_way(mesh, tip, outer))) {
      if (zones.tip[node] != none) continue;
      zones.tip[node] = tip;
      SPREKK_ASSERT(weight > 0 && weight <= 1, node, weight);
      zones.weight[node] = weight;
    }
  }
  return zones;
}

}  // namespace sprekk
