// Which rank owns which cell.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Fills cell_rank by recursive coordinate bisection of the cell centres: each part is cut across its longer extent.
/// The numbers of cells of the ranks differ by at most one. The same mesh always gets the same parts. The mesh gets a
/// new version. Throws std::logic_error for fewer than one rank.
void partition(Mesh& mesh, int ranks);

}  // namespace sprekk
