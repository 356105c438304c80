// What a part says of the balances of a conserved quantity: one call, and each term by what it is.
#pragma once

#include "framework/types.hpp"

namespace sprekk {

class Assembly;
class Field;

/// The rows of one field as balances of a quantity: stored + outflow = supplied, in amounts over the step. From
/// Assembly::balance, in each assemble(); terms of rows that are not in the solve are ignored, as everywhere.
///
///   BalanceRows fluid = assembly.balance(pressure_, "fluid");
///   fluid.store(capacity.cwiseProduct(p.now() - p.accepted()), largest_of(capacity, p.now()));
///   fluid.exchange(dt * outflow, dt * outflow_through_the_boundary, dt * largest_conductance * largest_pressure);
///   fluid.supply(dt * source);
///
/// Terms that are told so need nothing else: the step is accepted only when the errors of the balances are small
/// against what is turned over, not only against what rows exchange, which may be any multiple of it; and the constant
/// mode of the potentials is held by the sum of the rows where the rows alone, rounded, do not hold it. Derivatives go
/// to Assembly::derivative; those of an exchange as an Operator that knows what leaves all rows together
/// (docs/numerics/constant_modes.md).
class BalanceRows {
 public:
  /// residual += amounts: what each row stores in the step. `largest`: a bound of the numbers whose differences these
  /// are, which leave round-off of their own size.
  void store(const Vector& amounts, double largest = 0);
  /// residual −= amounts: what is brought in from outside of all balances.
  void supply(const Vector& amounts);
  /// residual += outflow: what each row gives to others. `leaving` adds up to what `outflow` would without round-off:
  /// what leaves all rows of the quantity together. `largest`: as in `store`, of each row; absent from the sum.
  void exchange(const Vector& outflow, const Vector& leaving, double largest = 0);
  /// Of amounts that other terms of these rows store, bring in or let out (by Assembly::linear, say); the sign does not
  /// matter.
  void turn_over(const Vector& amounts);

 private:
  friend class Assembly;
  BalanceRows(Assembly& assembly, const Field& row, int unknown) : assembly_(assembly), row_(row), unknown_(unknown) {}

  Assembly& assembly_;
  const Field& row_;
  int unknown_;  ///< none where the rows are not in the solve
};

}  // namespace sprekk
