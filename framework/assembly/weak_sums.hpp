// Sums of balances that hold a level which their rows, rounded, do not.
#pragma once

#include <vector>

#include "framework/assembly/assembly.hpp"

namespace sprekk {

/// Whether little holds the level of what balances exchange: less than 1e-6 of the exchange itself. Their rows, whose
/// entries are rounded, then have lost it, and their sum has not. Where other unknowns of a bulk answer to the level,
/// how much they hold is known with the solution only: there `also_answered` decides, which who has seen the level lost
/// sets. Never where values are fixed in place of balances. Collective; needs the derivatives.
bool is_weak(const Assembly& assembly, const Assembly::Conserved& conserved, bool also_answered = false);

/// The sum of all rows of the derivatives.
struct SumRow {
  std::vector<int> columns;  ///< ascending, counted over all unknowns of the assembly; no entry is zero
  std::vector<double> values;
};

// `owned`: of every row of every unknown, whether it is this process's. `first`: of every unknown, its first row and
// column among those of all. Collective; every process gets the same.

SumRow sum_of_rows(const Assembly& assembly, const Assembly::Conserved& conserved,
                   const std::vector<std::vector<char>>& owned, const std::vector<int>& first);

/// The row that exchanges most, counted over all unknowns: the one that the sum may replace.
int row_to_replace(const Assembly& assembly, const Assembly::Conserved& conserved,
                   const std::vector<std::vector<char>>& owned, const std::vector<int>& first);

/// The sum of the residuals of the balances of one unknown, without what is exchanged. Collective.
double sum_of_residuals(const Assembly& assembly, int unknown, const std::vector<char>& owned);

}  // namespace sprekk
