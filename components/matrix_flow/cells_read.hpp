// The cells on which a local problem of the flow depends.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk::matrix_flow {

/// For each node, ascending, the cells whose geometry and mobility its local problem may read: its own; near a tip also
/// those to which the flow around the tip is fitted, and those of all nodes near the same tip (dissipative_share).
Adjacency cells_read(const Mesh& mesh);

}  // namespace sprekk::matrix_flow
