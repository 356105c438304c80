// A sparse matrix from a list of its entries.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// The matrix with the sums of the entries.
inline SparseMatrix matrix_of(Eigen::Index rows, Eigen::Index columns, const std::vector<Triplet>& entries) {
  SparseMatrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace sprekk
