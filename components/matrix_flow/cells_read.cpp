#include "components/matrix_flow/cells_read.hpp"

#include "components/matrix_flow/cells_around_tips.hpp"
#include "framework/discretization/ends_nearby.hpp"

namespace sprekk::matrix_flow {

Adjacency cells_read(const Mesh& mesh) {
  const std::vector<int> tips = ends_nearby(mesh);
  auto around = cells_around_tips(mesh, tips);
  for (int node = 0; node < mesh.node_count(); ++node)
    if (tips[node] != none)
      around.at(tips[node])
          .insert(around.at(tips[node]).end(), mesh.node_cells[node].begin(), mesh.node_cells[node].end());
  Adjacency cells;
  std::vector<int> of_node;
  for (int node = 0; node < mesh.node_count(); ++node) {
    of_node.assign(mesh.node_cells[node].begin(), mesh.node_cells[node].end());
    if (tips[node] != none) of_node.insert(of_node.end(), around.at(tips[node]).begin(), around.at(tips[node]).end());
    cells.append_set(of_node);
  }
  return cells;
}

}  // namespace sprekk::matrix_flow
