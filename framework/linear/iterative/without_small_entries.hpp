// What a multigrid of potentials needs of its matrix.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// A square matrix without the entries that are small beside the diagonals of both their row and their column: they are
/// added to the diagonal, so that constants have the same residuals. A row that would lose half of its diagonal stays
/// whole. `rows` are those of this process, `ids` their numbers. Collective.
SparseMatrix without_small_entries(const SparseMatrix& rows, const std::vector<int>& ids);

}  // namespace sprekk
