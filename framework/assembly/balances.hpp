// Balances of conserved quantities, and what is left of them when they are added up.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// What the parts have said of balances while they assembled one state. With the sums of rows, in which exchanges are
/// absent, the constant mode of their potentials is held by all the digits that storage and boundaries have
/// (docs/numerics/constant_modes.md). An unknown is a number in the assembly's order. Parts write into it by
/// BalanceRows.
class Balances {
 public:
  explicit Balances(std::size_t unknowns) : of_(unknowns) {}

  /// Balances that are added up: their constant modes are one.
  struct Quantity {
    std::string name;
    std::vector<int> unknowns;
    bool has(int unknown) const { return std::find(unknowns.begin(), unknowns.end(), unknown) != unknowns.end(); }
  };

  /// The rows of an unknown are balances of a quantity; `so_far`: their residual until now. Throws std::logic_error
  /// where that has been said before. `field` is its name.
  void declare(int unknown, const std::string& field, const std::string& quantity, const Vector& so_far);
  bool are_rows_of(int unknown) const { return of_[unknown].residual.size() > 0; }

  // Of an unknown whose rows are balances; for others nothing happens.
  void add(int unknown, const Vector& values);
  void turn_over(int unknown, const Vector& amounts);
  void compare_round_off(int unknown, double largest);

  const std::vector<Quantity>& quantities() const { return quantities_; }
  /// The residual without what rows exchange, to be added up.
  const Vector& residual(int unknown) const { return of_[unknown].residual; }
  /// What each row stores, what is brought in and what leaves all rows: not negative; as wrong as a residual where the
  /// row is another process's.
  const Vector& turnover(int unknown) const { return of_[unknown].turnover; }
  /// Of the sum of all rows: the largest sum of absolute values of a term, and of the numbers whose differences it is.
  double magnitude(int unknown) const { return of_[unknown].magnitude; }
  double round_off_base(int unknown) const { return of_[unknown].round_off_base; }

 private:
  struct Rows {
    Vector residual, turnover;  ///< empty where the rows are no balances
    double magnitude = 0, round_off_base = 0;
  };
  std::vector<Rows> of_;
  std::vector<Quantity> quantities_;
};

}  // namespace sprekk
