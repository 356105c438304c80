// The sum of two sparse matrices.
#pragma once

#include "framework/types.hpp"

namespace sprekk {

/// a + b, in the memory that it needs; Eigen's sum takes several times as much.
SparseMatrix sparse_sum(const SparseMatrix& a, const SparseMatrix& b);

}  // namespace sprekk
