// Sums of balances that hold a constant mode which their rows, rounded, do not.
#pragma once

#include <vector>

#include "framework/assembly/assembly.hpp"
#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Whether little holds the constant mode of what balances exchange: less than 1e-6 of the exchange itself. Their rows,
/// whose entries are rounded, then have lost it, and their sum has not. Where other unknowns of a bulk answer to the
/// mode, how much they hold is known with the solution only: there `also_answered` decides, which who has seen the mode
/// lost sets. Never where values are fixed in place of balances. Collective; needs the derivatives.
bool is_weak(const Assembly& assembly, const Balances::Quantity& quantity, bool also_answered = false);

/// The sum of all rows of the derivatives.
struct SumRow {
  std::vector<int> columns;  ///< ascending, counted over all unknowns of the assembly; no entry is zero
  std::vector<double> values;
};

// `owned`: of every row of every unknown, whether it is this process's. `first`: of every unknown, its first row and
// column among those of all. Collective; every process gets the same.

SumRow sum_of_rows(const Assembly& assembly, const Balances::Quantity& quantity,
                   const std::vector<std::vector<char>>& owned, const std::vector<int>& first);

/// The row that exchanges most, counted over all unknowns: the one that the sum may replace.
int row_to_replace(const Assembly& assembly, const Balances::Quantity& quantity,
                   const std::vector<std::vector<char>>& owned, const std::vector<int>& first);

/// The sum of the residuals of the balances of one unknown, without what is exchanged. Collective.
double sum_of_residuals(const Assembly& assembly, int unknown, const std::vector<char>& owned);

/// Puts sums of balances in the place of one of them, in the systems of one solve.
class BalanceSums {
 public:
  /// Where rows alone lose the mode (is_weak). For direct solvers only: the row of a sum is no elliptic one.
  bool are_used = false;
  /// Also where other unknowns of a bulk depend on the mode. Costs a row coupled to all of them.
  bool are_used_where_answered = false;

  /// Whether the sum of these balances takes the place of one of them. Collective.
  bool replace_a_row(const Assembly& assembly, const Balances::Quantity& quantity) const {
    return are_used && is_weak(assembly, quantity, are_used_where_answered);
  }
  /// Makes the system that `with_sums` returns from the `plain` one of an assembly. Collective.
  void put_into(const LinearSystem& plain, const Assembly& assembly, const std::vector<std::vector<char>>& owned,
                const std::vector<int>& first);
  /// The last system, with sums; the plain one, where none is needed.
  const LinearSystem& with_sums(const LinearSystem& plain) const { return replaced_.empty() ? plain : with_sums_; }

  /// The balances of which one row of the last system is the sum, and its place among the owned rows, -1 where another
  /// process has it.
  struct Replaced {
    Balances::Quantity quantity;
    int place;
  };
  const std::vector<Replaced>& replaced() const { return replaced_; }

 private:
  std::vector<Replaced> replaced_;
  LinearSystem with_sums_;
};

}  // namespace sprekk
