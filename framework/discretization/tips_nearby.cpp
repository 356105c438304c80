#include "framework/discretization/tips_nearby.hpp"

#include <algorithm>
#include <limits>

#include "framework/discretization/tip_surroundings.hpp"
#include "framework/invariants.hpp"

namespace sprekk {
namespace {

/// Number of edges from the tip to where linear functions suffice: their error falls with the square of the distance.
constexpr int layers = 3;
/// Halfway between two tips both fields are as strong, and a symmetric mesh must have a symmetric result: neither tip
/// is taken.
constexpr double clearly = 0.9;

}  // namespace

std::vector<int> tips_nearby(const Mesh& mesh) {
  constexpr double far = std::numeric_limits<double>::infinity();
  struct Nearest {
    int tip = none;
    double distance = far, next = far;  ///< m, to the tip and to the second nearest
  };
  std::vector<Nearest> nearest(mesh.node_count());
  for (int tip = 0; tip < mesh.node_count(); ++tip) {
    if (!is_tip(mesh, tip)) continue;
    for (const int node : nodes_around_tip(mesh, tip, layers)) {
      Nearest& at = nearest[node];
      const double distance = (mesh.nodes[node] - mesh.nodes[tip]).norm();
      at.next = std::min(at.next, std::max(at.distance, distance));
      if (distance < at.distance) at = {tip, distance, at.next};
    }
  }
  std::vector<int> nearby;
  for (const Nearest& at : nearest) nearby.push_back(at.distance < clearly * at.next ? at.tip : none);
  SPREKK_ASSERT(static_cast<int>(nearby.size()) == mesh.node_count(), nearby.size(), mesh.node_count());
  return nearby;
}

}  // namespace sprekk
