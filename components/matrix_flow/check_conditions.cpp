#include "components/matrix_flow/check_conditions.hpp"

#include <stdexcept>
#include <string>

namespace sprekk::matrix_flow {

void check_conditions(const Mesh& mesh, const std::vector<Tensor>& mobility,
                      const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes) {
  if (static_cast<int>(mobility.size()) != mesh.cell_count())
    throw std::invalid_argument("flux discretization: one mobility a cell is needed");
  if (static_cast<int>(conditions.size()) != mesh.face_count())
    throw std::invalid_argument("flux discretization: one condition a face is needed");
  if (!nodes.empty() && static_cast<int>(nodes.size()) != mesh.node_count())
    throw std::invalid_argument("flux discretization: one flag a node is needed, or none at all");
  for (int face = 0; face < mesh.face_count(); ++face)
    if ((conditions[face] == FlowCondition::none) != (mesh.face_cells[face][1] != none))
      throw std::invalid_argument("flux discretization: face " + std::to_string(face) +
                                  (conditions[face] == FlowCondition::none ? " has one cell and no condition"
                                                                           : " has two cells and a condition"));
}

}  // namespace sprekk::matrix_flow
