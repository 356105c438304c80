#include "components/matrix_flow/cells_read.hpp"

namespace sprekk::matrix_flow {

Adjacency cells_read(const Mesh& mesh) { return mesh.node_cells; }

}  // namespace sprekk::matrix_flow
