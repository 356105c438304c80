// A mesh that is cut along the boundary of some of its cells.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// The mesh, cut between the cells that are `inside` (one flag a cell) and the others: the faces between them are
/// doubled, and belong to the outer boundary, without a side, of both parts. Cells, walls and fractures keep their
/// numbers. A doubled face keeps its number as that of the cell inside, out of which it then points, a doubled node as
/// that of the cells inside; the copies for the other cells come after all others. The result has a version of its own.
Mesh separated_mesh(const Mesh& mesh, const std::vector<char>& inside);

}  // namespace sprekk
