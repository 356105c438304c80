// The product of two sparse matrices.
#pragma once

#include "framework/types.hpp"

namespace sprekk {

/// a b, in the memory that it needs; Eigen's product takes several times as much. Its bits are those of Eigen's.
SparseMatrix sparse_product(const SparseMatrix& a, const SparseMatrix& b);

}  // namespace sprekk
