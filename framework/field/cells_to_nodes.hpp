// Values at nodes from those of cells, for what needs them there: contours, streamlines, warped pictures.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Weights (nodes × cells) of the values at nodes: those of the linear function that fits the cells around the node
/// best, weighted by their areas. Exact for linear fields, on the boundary and on fractures, too. A node on a fracture
/// exists for each side (Mesh), and has the cells on its side alone. Where the cells around a node do not determine a
/// linear function, those beyond their faces count, too.
SparseMatrix cells_to_nodes(const Mesh& mesh);

}  // namespace sprekk
