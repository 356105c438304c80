#include "components/matrix_flow/cells_around_tips.hpp"

#include <algorithm>

namespace sprekk::matrix_flow {

std::map<int, std::vector<int>> cells_around_tips(const Mesh& mesh, const std::vector<int>& tips) {
  std::map<int, std::vector<int>> around;
  for (int tip = 0; tip < mesh.node_count(); ++tip) {
    if (tips[tip] != tip) continue;
    std::vector<int>& cells = around[tip];
    for (const int cell : mesh.node_cells[tip])
      for (const int node : mesh.cell_nodes[cell])
        if (tips[node] == tip) cells.insert(cells.end(), mesh.node_cells[node].begin(), mesh.node_cells[node].end());
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  }
  return around;
}

}  // namespace sprekk::matrix_flow
