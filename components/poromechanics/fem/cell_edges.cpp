#include "components/poromechanics/fem/cell_edges.hpp"

#include <algorithm>

namespace sprekk::poromechanics {

bool CellEdges::are_in(int cell) const {
  return count() > 0 && std::ranges::any_of(of_cell[cell], [](int edge) { return edge != none; });
}

Point CellEdges::shift(const Mesh& mesh, int edge) const {
  const auto& [one, other] = nodes[edge];
  if (is_at_rim[one] == is_at_rim[other]) return Point::Zero();
  return (is_at_rim[one] ? 1 : -1) * (mesh.nodes[one] - mesh.nodes[other]) / 4;
}

}  // namespace sprekk::poromechanics
