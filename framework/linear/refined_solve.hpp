// Checks the true residual of a direct solve, and refines the solution.
#pragma once

#include <functional>

#include "framework/linear/equilibration.hpp"
#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Solves R A C y = R b by `apply_inverse`, which is given this process's rows of R b and makes of them the whole of y;
/// x = C y. Collective. Up to three steps of iterative refinement follow while the componentwise backward error of the
/// true residual is above 1e-13 and falls: unlike a norm, this error sees blocks whose values are small beside those of
/// others. `solved` is false when the normwise backward error ||r|| / (||A|| ||y|| + ||R b||) stays above 1e-10, or the
/// relative residual ||r|| / ||R b|| above 0.3: then the matrix is so near-singular that x means nothing. A solution
/// between these bounds and round-off is accepted: the next iteration of Newton's method improves it.
LinearReport refined_solve(const LinearSystem& system, const Equilibrated& scaled, const Vector& b_rows,
                           const std::function<void(Vector&)>& apply_inverse, Vector& x);

/// max_i |r_i| / (|A| |y| + |b|)_i for r = b - A y: the smallest relative change of the entries of A and b that makes y
/// exact (Arioli, Demmel and Duff 1989). `y` is whole, the rest are this process's rows. Collective.
double componentwise_backward_error(const SparseMatrix& a, const Vector& y, const Vector& b, const Vector& r);

/// The rows of this process, put at their places in a vector of the whole system. Collective. Where the same rows are
/// made whole often, parallel::WholeVectors is better.
Vector whole_vector(const std::vector<int>& rows, const Vector& mine, int unknowns);

}  // namespace sprekk
