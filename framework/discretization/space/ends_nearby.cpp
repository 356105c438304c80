#include "framework/discretization/ends_nearby.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "framework/discretization/nodes_around_end.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/space/rim.hpp"

namespace sprekk {
namespace {

/// Cosine of the angle (60 degrees) between the directions ahead from which on two ends belong to different rims of a
/// fracture, whose fields are not the same one: opposite parts of a rim compete for a node, neighbours do not.
constexpr double same_rim = 0.5;

/// What a node of a rim belongs to.
struct Rim {
  int fracture;
  Point ahead;

  Rim(const Mesh& mesh, int node) : Rim(mesh, rim_at(mesh, node).front()) {}
  Rim(const Mesh& mesh, const RimEdge& edge)
      : fracture(mesh.fracture_cells[edge.cell].fracture), ahead(edge.axes.col(0)) {}
  bool is_that_of(const Rim& other) const { return fracture == other.fracture && ahead.dot(other.ahead) > same_rim; }
};

}  // namespace

std::vector<int> ends_nearby(const Mesh& mesh, const EndLimits& limits) {
  SPREKK_EXPECT(limits.layers > 0 && limits.clearly > 0 && limits.clearly < 1, limits.layers, limits.clearly);
  const std::vector<char> is_rim = nodes_of_rims(mesh);
  std::vector<std::vector<std::pair<double, int>>> reached(mesh.node_count());  // distances, m, and nodes of rims
  std::map<int, Rim> rims;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (!is_rim[node]) continue;
    rims.emplace(node, Rim(mesh, node));
    for (const int near : nodes_around_end(mesh, node, limits.layers))
      reached[near].emplace_back((mesh.nodes[near] - mesh.nodes[node]).norm(), node);
  }
  std::vector<int> nearby(mesh.node_count(), none);
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (reached[node].empty()) continue;
    const auto nearest = *std::ranges::min_element(reached[node]);
    const Rim& rim = rims.at(nearest.second);
    const bool is_clear = std::ranges::all_of(reached[node], [&](const auto& other) {
      return nearest.first < limits.clearly * other.first || rims.at(other.second).is_that_of(rim);
    });
    if (is_clear && is_fracture_end(mesh, nearest.second)) nearby[node] = nearest.second;
  }
  return nearby;
}

int end_of_cell(const Mesh& mesh, int cell, const std::vector<int>& ends) {
  const CellNodes& nodes = mesh.cell_nodes[cell];
  if (std::ranges::any_of(nodes, [&](int node) { return ends[node] == none; })) return none;
  const auto distance = [&](int node) { return (mesh.nodes[ends[node]] - mesh.cell_center[cell]).norm(); };
  const int nearest = ends[*std::ranges::min_element(nodes, {}, distance)];
  const Rim rim(mesh, nearest);
  return std::ranges::all_of(nodes, [&](int node) { return Rim(mesh, ends[node]).is_that_of(rim); }) ? nearest : none;
}

}  // namespace sprekk
