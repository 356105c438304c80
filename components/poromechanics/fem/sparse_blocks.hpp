// Sparse matrices of vectors at nodes and faces.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk::poromechanics {

/// The matrix with the sums of the entries.
inline SparseMatrix made(int rows, int columns, const std::vector<Triplet>& entries) {
  SparseMatrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Adds the entries of a block that are not 0.
inline void put(std::vector<Triplet>& entries, int row, int column, const Tensor& block) {
  for (int i = 0; i < dimension; ++i)
    for (int j = 0; j < dimension; ++j)
      if (block(i, j) != 0) entries.emplace_back(row + i, column + j, block(i, j));
}

}  // namespace sprekk::poromechanics
