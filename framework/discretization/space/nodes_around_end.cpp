#include "framework/discretization/nodes_around_end.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>

#include "framework/invariants.hpp"
#include "framework/mesh/space/rim.hpp"

namespace sprekk {
namespace {

/// Degrees: beyond a sharper bend of a rim, or of a fracture, the field of the end is another one.
constexpr double largest_bend = 10, largest_corner = 45;
const double straight = std::cos(largest_bend * std::numbers::pi / 180),
             curved = std::cos(largest_corner * std::numbers::pi / 180);

/// Whether the walls at a node are those of one fracture, whose normal is like the given one, and other faces with one
/// cell are across the rim.
bool is_undisturbed(const Mesh& mesh, int node, int fracture, const Tensor& axes) {
  if (mesh.node_cells[node].size() < 2) return false;
  return std::ranges::all_of(mesh.node_faces[node], [&](int face) {
    if (mesh.face_cells[face][1] != none) return true;
    const int wall = mesh.face_fracture_cell[face];
    if (wall == none) return std::abs(mesh.face_normal[face].dot(axes.col(2))) > straight;
    const FractureCell& cell = mesh.fracture_cells[wall];
    return cell.fracture == fracture && -cell.normal.dot(axes.col(1)) > straight;
  });
}

}  // namespace

bool is_fracture_end(const Mesh& mesh, int node) {
  const std::vector<RimEdge> rim = rim_at(mesh, node);
  if (rim.empty() || rim.size() > 2 || rim[0].axes.col(0).dot(rim.back().axes.col(0)) < curved) return false;
  const auto is_on_side = [&](int face) {
    return mesh.face_cells[face][1] == none && mesh.face_fracture_cell[face] == none;
  };
  return (rim.size() == 1) == std::ranges::any_of(mesh.node_faces[node], is_on_side) &&
         is_undisturbed(mesh, node, mesh.fracture_cells[rim[0].cell].fracture, rim[0].axes);
}

std::vector<int> nodes_around_end(const Mesh& mesh, int end, int edges) {
  SPREKK_EXPECT(edges >= 0, edges);
  const std::vector<RimEdge> rim = rim_at(mesh, end);
  SPREKK_EXPECT(!rim.empty(), end);
  const int fracture = mesh.fracture_cells[rim[0].cell].fracture;
  std::vector<int> reached{end};
  std::unordered_set<int> seen{end};
  const auto visit = [&](int node) {
    if (seen.insert(node).second && is_undisturbed(mesh, node, fracture, rim[0].axes)) reached.push_back(node);
  };
  for (int layer = 0, begin = 0; layer < edges; ++layer)
    for (const int layer_end = static_cast<int>(reached.size()); begin < layer_end; ++begin) {
      const int from = reached[begin];
      for (const int face : mesh.node_faces[from]) {
        const FaceNodes& nodes = mesh.face_nodes[face];
        const int at = static_cast<int>(std::find(nodes.begin(), nodes.end(), from) - nodes.begin());
        visit(nodes.before(at));
        visit(nodes.after(at));
      }
    }
  return reached;
}

}  // namespace sprekk
