// Finds out whether a factorized matrix is singular to working precision, and in which unknown.
#pragma once

#include <functional>
#include <string>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Solves in place for the whole right-hand side, with the equilibrated matrix or its transpose.
using SolveInPlace = std::function<void(Vector&)>;

/// Looks for a unit vector v of the numerical null space, || A v || < 3e-15 || |A| |v| ||, by inverse iteration on A^T
/// A from a fixed pseudo-random vector. Returns "" or a sentence that names the unknown in which v is largest: the rock
/// block that floats, the pressure without a boundary value. A vector v for which a sum of balances
/// (LinearSystem::sums) is not zero does not count, however small the entries of that row are: their size beside other
/// entries of the row may be a matter of units. `rows` are this process's rows of the equilibrated matrix. Collective.
/// The residual of a solve shows singular matrices that this test misses. Costs one solve for a good matrix, seven for
/// a suspicious one.
std::string find_singularity(const LinearSystem& system, const SparseMatrix& rows, const SolveInPlace& solve,
                             const SolveInPlace& solve_transposed);

}  // namespace sprekk
