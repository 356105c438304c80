// A mesh that is cut along the boundary of some of its cells.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// The mesh with the faces between a cell that is `inside` (one flag a cell) and one that is not doubled, so that it is
/// an outer boundary without a side on both. Cells, walls and fractures keep their numbers. A doubled face keeps its
/// number as that of the cell inside, out of which it then points, a doubled node as that of the cells inside; the
/// copies for the cells that are not come behind all others. It has a version of its own.
Mesh separated_mesh(const Mesh& mesh, const std::vector<char>& inside);

}  // namespace sprekk
