#include "framework/discretization/plane/end_surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/invariants.hpp"

namespace sprekk {
namespace {

constexpr double largest_bend = 10;  ///< degrees: beyond a sharper bend the field of the end is another one
const double straight = std::cos(largest_bend * std::numbers::pi / 180);

}  // namespace

NodeWalls::NodeWalls(const Mesh& mesh, int node) {
  SPREKK_EXPECT(is_index(node, mesh.node_count()), node, mesh.node_count());
  int count = 0;
  for (const int face : mesh.node_faces[node]) {
    if (mesh.face_cells[face][1] != none) continue;
    are_all = are_all && count < 2 && mesh.face_fracture_cell[face] != none;
    if (are_all) cells[count++] = mesh.face_fracture_cell[face];
  }
}

bool is_fracture_end(const Mesh& mesh, int node) {
  const NodeWalls walls(mesh, node);
  return walls.are_all && walls.cells[0] != none && walls.cells[0] == walls.cells[1];
}

bool is_field_undisturbed(const Mesh& mesh, int node, const FractureCell& last) {
  if (mesh.node_cells[node].size() < 2) return false;
  const NodeWalls walls(mesh, node);
  return walls.are_all && std::all_of(walls.cells.begin(), walls.cells.end(), [&](int i) {
           return i == none || (mesh.fracture_cells[i].fracture == last.fracture &&
                                mesh.fracture_cells[i].tangents.dot(last.tangents) > straight);
         });
}

std::vector<int> nodes_around_end(const Mesh& mesh, int end, int edges) {
  SPREKK_EXPECT(is_fracture_end(mesh, end), end);
  SPREKK_EXPECT(edges >= 0, edges);
  const FractureCell& last = mesh.fracture_cells[NodeWalls(mesh, end).cells[0]];
  std::vector<int> reached{end};
  for (int layer = 0, begin = 0; layer < edges; ++layer) {
    const int layer_end = static_cast<int>(reached.size());
    for (; begin < layer_end; ++begin)
      for (const int face : mesh.node_faces[reached[begin]])
        for (const int node : mesh.face_nodes[face])
          if (std::find(reached.begin(), reached.end(), node) == reached.end() &&
              is_field_undisturbed(mesh, node, last))
            reached.push_back(node);
  }
  return reached;
}

}  // namespace sprekk
