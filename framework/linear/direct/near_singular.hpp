// Finds out whether a factorized matrix is singular to working precision, and in which unknown.
#pragma once

#include <functional>
#include <string>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Turns this process's rows of a vector b into the whole of A^-1 b, with the equilibrated matrix.
using ApplyInverse = std::function<void(Vector&)>;

/// Looks for a null vector v of A up to round-off: a relative change of A by 3e-15 in the norm of all rows, and by
/// 1e-13 in each row, makes A v zero, and right-hand sides as large as the terms |A| |v| have solutions 1e8 times as
/// large as v. The last test does not depend on the scales of rows and columns, unlike a norm: a sum of balances that
/// determines the constant mode of a pressure may be small beside other entries of its row. Returns "" or a sentence
/// that names the unknown in which v is largest: the rock block that floats, the pressure without a boundary value.
/// `rows` are this process's rows of the equilibrated matrix. Collective. The residual of a solve shows singular
/// matrices that this test misses. Costs one solve for a good matrix, five or seven for a suspicious one.
std::string find_singularity(const LinearSystem& system, const SparseMatrix& rows, const ApplyInverse& apply_inverse);

}  // namespace sprekk
