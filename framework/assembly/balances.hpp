// Balances of conserved quantities, and their sums.
#pragma once

#include <string>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// The balances that parts have declared while they assembled one state, with their terms in the sum of all rows. In
/// such a sum exchanges are absent, so it holds the constant mode of the potentials with all digits of storage and
/// boundary terms (docs/numerics/constant_modes.md). Unknowns are numbers in the order of the assembly. Parts write
/// into it by BalanceRows.
class Balances {
 public:
  explicit Balances(std::size_t unknowns);

  /// The balances of one quantity, which are added up: their potentials share one constant mode.
  struct Quantity {
    std::string name;
    std::vector<int> unknowns;
    bool has(int unknown) const;
  };

  /// Declares the rows of an unknown as balances of a quantity. `field`: the name of the unknown; `so_far`: the
  /// residual of its rows until now. Throws std::logic_error for a second declaration.
  void declare(int unknown, const std::string& field, const std::string& quantity, const Vector& so_far);
  bool are_rows_of(int unknown) const { return of_[unknown].residual.size() > 0; }

  // The next three functions add to the balances of an unknown, without effect where its rows are no balances.
  void add(int unknown, const Vector& values);
  void add_throughput(int unknown, const Vector& amounts);
  void compare_round_off(int unknown, double largest);

  const std::vector<Quantity>& quantities() const { return quantities_; }
  /// The residual of each row without exchanges; these may be added up.
  const Vector& residual(int unknown) const { return of_[unknown].residual; }
  /// The throughput of each row, not negative: what it stores, what sources bring in and what leaves all rows. Right on
  /// rows that this process owns.
  const Vector& throughput(int unknown) const { return of_[unknown].throughput; }
  /// Of the sum of all rows: the size of its largest term (the sum of the absolute values of that term in all rows).
  double magnitude(int unknown) const { return of_[unknown].magnitude; }
  /// Of the sum of all rows: the size of the numbers whose differences make up the terms. They leave round-off of their
  /// own size in the sum.
  double round_off_base(int unknown) const { return of_[unknown].round_off_base; }

 private:
  struct Rows {
    Vector residual, throughput;  ///< empty where the rows are no balances
    double magnitude = 0, round_off_base = 0;
  };
  std::vector<Rows> of_;
  std::vector<Quantity> quantities_;
};

}  // namespace sprekk
