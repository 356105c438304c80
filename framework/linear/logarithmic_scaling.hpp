// Scales of a matrix for which the logarithms of its entries are small.
#pragma once

#include "framework/linear/equilibration.hpp"

namespace sprekk {

/// Gives the matrix other scales: those for which the sum of log^2 |r_i a_ij c_j| over the entries that are not zero is
/// least (Curtis and Reid 1972, "On the automatic scaling of matrices for Gaussian elimination"), by alternating least
/// squares; then rows and columns are divided by their largest entries. All scales are rounded to powers of two.
///
/// Scales of the maximum norm alone are not unique: where rows of several kinds have entries of very different sizes,
/// they may leave what determines an unknown below the round-off of the largest entries, though it is large beside all
/// that it is added to. A singular matrix is singular in every scaling; one that is so in the scales of the maximum
/// norm only is solved in these. Collective.
void rescale_by_logarithms(Equilibrated& scaled);

}  // namespace sprekk
