#include "framework/discretization/ends_nearby.hpp"

#include <algorithm>
#include <limits>

#include "framework/discretization/plane/end_surroundings.hpp"
#include "framework/invariants.hpp"

namespace sprekk {

std::vector<int> ends_nearby(const Mesh& mesh, const EndLimits& limits) {
  SPREKK_EXPECT(limits.layers > 0 && limits.clearly > 0 && limits.clearly < 1, limits.layers, limits.clearly);
  constexpr double far = std::numeric_limits<double>::infinity();
  struct Nearest {
    int end = none;
    double distance = far, next = far;  ///< m, to the end and to the second nearest
  };
  std::vector<Nearest> nearest(mesh.node_count());
  for (int end = 0; end < mesh.node_count(); ++end) {
    if (!is_fracture_end(mesh, end)) continue;
    for (const int node : nodes_around_end(mesh, end, limits.layers)) {
      Nearest& at = nearest[node];
      const double distance = (mesh.nodes[node] - mesh.nodes[end]).norm();
      at.next = std::min(at.next, std::max(at.distance, distance));
      if (distance < at.distance) at = {end, distance, at.next};
    }
  }
  std::vector<int> nearby;
  for (const Nearest& at : nearest) nearby.push_back(at.distance < limits.clearly * at.next ? at.end : none);
  SPREKK_ASSERT(static_cast<int>(nearby.size()) == mesh.node_count(), nearby.size(), mesh.node_count());
  return nearby;
}

int end_of_cell(const Mesh& mesh, int cell, const std::vector<int>& ends) {
  const int end = ends[mesh.cell_nodes[cell][0]];
  return std::ranges::all_of(mesh.cell_nodes[cell], [&](int node) { return ends[node] == end; }) ? end : none;
}

}  // namespace sprekk
