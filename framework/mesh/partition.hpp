// Which rank owns which cell.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// `compact`: recursive coordinate bisection of the cell centres, each part cut across its longest extent; the numbers
/// of cells of the ranks differ by at most one. The others are for tests: `scattered`: each cell at random; `lopsided`:
/// the last rank has the cell at the minus side of the first fracture cell alone (none without fractures), the first
/// one all others, and those between have nothing.
enum class Division { compact, scattered, lopsided };

/// Fills cell_rank. The same mesh always gets the same parts. The mesh gets a new version. Throws std::logic_error for
/// fewer than one rank.
void partition(Mesh& mesh, int ranks, Division division = Division::compact);

}  // namespace sprekk
