// Scales a matrix so that the largest entry of every row and column is near one.
#pragma once

#include <string>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// The scaled matrix R A C and its scales. All scales are powers of two, so scaling rounds nothing, and the residual of
/// the scaled system is exactly R times that of the original one.
struct Equilibrated {
  SparseMatrix matrix;  ///< this process's rows of R A C
  Vector row_scale;     ///< R, one entry for each row of this process
  Vector column_scale;  ///< C, one entry for each unknown of the whole system
  double norm = 0;      ///< of the scaled matrix of all processes, the root of the sum of the squares of its entries
  std::string mistake;  ///< why the matrix cannot be solved: an empty row or column, or an entry that is no number
};

/// Ruiz 2001, "A scaling algorithm to equilibrate both rows and columns norms in matrices", in the maximum norm.
/// Collective. The matrix is compressed if it was not.
Equilibrated equilibrate(const LinearSystem& system);

}  // namespace sprekk
