#include "components/poromechanics/mpsa/local_stresses.hpp"
#include "components/poromechanics/mpsa/tips.hpp"

namespace sprekk::poromechanics {

Adjacency local_cells(const Mesh& mesh, const Tips& tips) {
  Adjacency cells;
  for (int node = 0; node < mesh.node_count(); ++node) {
    std::vector<int> of_node = cells_and_beyond(mesh, node);
    const std::span<const int> near_tip = tips.cells_near(node);
    of_node.insert(of_node.end(), near_tip.begin(), near_tip.end());
    cells.append_set(of_node);
  }
  return cells;
}

}  // namespace sprekk::poromechanics
