// The eigenvalue of a condensed matrix at which it stops being positive.
#pragma once

#include <optional>
#include <vector>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Some unknowns x_i of a system A, and for each the row that stands for its own equation and a factor.
struct CondensedUnknowns {
  std::vector<int> rows, columns;  ///< global numbers, one a value
  Vector factors;                  ///< not zero
};

/// With S the Schur complement of A on these rows and columns, in which all other equations hold, and
/// M_ij = S_ij / factor_i: an eigenvalue of M, and its eigenvector of length 1.
struct CondensedEigenpair {
  double value;
  Vector vector;
};

/// The negative real eigenvalue of M nearest to zero; nothing if there is none, or if this is not certain. `solver` has
/// factorized A, whose rows on this process are `rows`. Since M^-1 = X^T A^-1 diag(factor), with X the unit columns of
/// the unknowns, eigenvalues nearest to zero are the largest ones of M^-1, which Arnoldi's method finds with a
/// back-solve each (at most 40). Collective.
std::optional<CondensedEigenpair> negative_eigenpair(LinearSolver& solver, const std::vector<int>& rows, int size,
                                                     const CondensedUnknowns& unknowns);

/// The smallest eigenvalue of M where all are positive; 0 where that is not certain. Takes no more back-solves than an
/// estimate to a tenth needs. Collective.
double smallest_if_positive(LinearSolver& solver, const std::vector<int>& rows, int size,
                            const CondensedUnknowns& unknowns);

}  // namespace sprekk
