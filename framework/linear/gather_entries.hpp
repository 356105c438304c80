// The entries of a matrix that several processes hold in parts, on all of them.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// The matrix of the entries of all processes, in their order; entries at one place add up. Collective.
SparseMatrix gather_entries(const std::vector<Triplet>& entries, int rows, int columns);

}  // namespace sprekk
