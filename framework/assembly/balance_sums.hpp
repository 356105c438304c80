// Sums of balances that hold a constant mode which the rounded rows do not hold.
#pragma once

#include <vector>

#include "framework/assembly/assembly.hpp"
#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Whether balances are near-singular for a constant mode: whether the derivatives without exchanges, applied to the
/// constant (sum of the absolute values in the rows), are at most 1e-6 of the largest exchange. The derivatives that
/// determine the constant are then lost in the round-off of the rows, but not in the sum of the rows without exchanges.
/// `summed`: all balances of a quantity, or those of one of its fields; for one field, its coupling to the others, also
/// through interfaces, counts among the derivatives that determine the constant. Where other unknowns of the bulk
/// respond to the constant, only the solution shows how far they determine it: the result is false there unless
/// `also_coupled`, which a caller sets after an attempt in which the constant was lost. Never true where values are
/// fixed in place of balances. Collective; needs the derivatives.
bool is_weak(const Assembly& assembly, const Balances::Quantity& summed, bool also_coupled = false);

/// A row of the Jacobian that is the sum of all rows of a quantity's balances.
struct SumRow {
  std::vector<int> columns;  ///< ascending, counted over all unknowns of the assembly; no entry is zero
  std::vector<double> values;
};

/// The sum of the rows of the balances. `owned`: for every row of every unknown, whether this process owns it. `first`:
/// for every unknown, its first row and column among all. Collective; every process gets the same.
SumRow sum_of_rows(const Assembly& assembly, const Balances::Quantity& quantity,
                   const std::vector<std::vector<char>>& owned, const std::vector<int>& first);

/// The row with the largest exchange, counted over all unknowns: the row that the sum may replace.
int row_to_replace(const Assembly& assembly, const Balances::Quantity& quantity,
                   const std::vector<std::vector<char>>& owned, const std::vector<int>& first);

/// The sum of the residuals of the balances of one unknown, without what rows exchange. Collective.
double sum_of_residuals(const Assembly& assembly, int unknown, const std::vector<char>& owned);

/// Puts the sum of balances in the place of one of them, in the systems of one solve.
class BalanceSums {
 public:
  /// Whether sums are used where the rounded rows lose the constant mode (is_weak). For direct solvers only: the row of
  /// a sum is not elliptic.
  bool are_used = false;
  /// Whether sums are also used where other unknowns of the bulk respond to the constant mode. The row of such a sum
  /// has entries in the columns of all these unknowns.
  bool are_used_where_coupled = false;

  /// The balances whose sums take the place of one of them: those of a quantity, and those of single fields of it that
  /// have a constant of their own, such as the matrix and fractures with nearly sealed walls. Arguments as of
  /// `sum_of_rows`. Collective.
  std::vector<Balances::Quantity> sums_of(const Assembly& assembly, const std::vector<std::vector<char>>& owned,
                                          const std::vector<int>& first) const;
  /// Makes the system that `with_sums` returns from the `plain` one of an assembly. Collective.
  void put_into(const LinearSystem& plain, const Assembly& assembly, const std::vector<std::vector<char>>& owned,
                const std::vector<int>& first);
  /// The last system, with sums; the plain one, where none is needed.
  const LinearSystem& with_sums(const LinearSystem& plain) const { return replaced_.empty() ? plain : with_sums_; }

  /// A sum of balances in the last system, and the place of its row among the owned rows, -1 where another process has
  /// the row.
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
