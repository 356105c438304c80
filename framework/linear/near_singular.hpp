// Finds out whether a factorized matrix is singular to working precision, and in which unknown.
#pragma once

#include <functional>
#include <string>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Solves in place for the whole right-hand side, with the equilibrated matrix or its transpose.
using SolveInPlace = std::function<void(Vector&)>;

/// Looks for a unit vector v with || A v || < 3e-15 || |A| |v| ||, by inverse iteration on A^T A from a fixed
/// pseudo-random vector. Returns "" or a sentence naming the unknown that v is largest in: the rock block that floats,
/// the pressure without a boundary value. A v that a sum of balances (LinearSystem::sums) resists is none, however
/// small the entries are by which it does: how large they are beside others of the row may be a matter of units. `rows`
/// are this process's rows of the equilibrated matrix. Collective. What slips through is seen by the residual of a
/// solve. Costs one solve for a good matrix, seven for a suspicious one.
std::string find_singularity(const LinearSystem& system, const SparseMatrix& rows, const SolveInPlace& solve,
                             const SolveInPlace& solve_transposed);

}  // namespace sprekk
