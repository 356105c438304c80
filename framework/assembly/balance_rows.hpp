// How a part declares the balances of a conserved quantity and adds their terms.
#pragma once

#include <string>

#include "framework/assembly/assembly.hpp"

namespace sprekk {

/// The rows of one field as balances of a quantity: stored + outflow = supplied, in amounts over the step. Parts
/// make one in each assemble(); terms of rows that are not in the solve are ignored.
///
///   BalanceRows fluid(assembly, pressure_, "fluid");
///   fluid.store(capacity.cwiseProduct(p.now() - p.accepted()), largest_of(capacity, p.now()));
///   fluid.exchange(dt * outflow, dt * outflow_through_the_boundary, dt * largest_conductance * largest_pressure);
///   fluid.supply(dt * source);
///
/// Two things follow from terms that are added in this way. The step is accepted only when the errors of the balances
/// are small against their throughput, and not only against what rows exchange, which may be any multiple of it. And
/// where the rounded rows alone do not hold the constant mode of the potentials, the sum of the rows holds it.
/// Derivatives are added by Assembly::derivative; those of an exchange as an Operator that knows what leaves all rows
/// together (docs/numerics/constant_modes.md).
class BalanceRows {
 public:
  /// Factor of `largest` (store) where what is stored is capacity times the change of a field in the step: each of the
  /// two values is wrong in its last digit, and Newton's method allows 64 last digits of `largest`.
  static constexpr double round_off_of_change = 1.0 / 32;

  /// Declares the rows of a field as balances of a quantity. To be made once, by the owner of the field, before any
  /// of their terms are added. The balances of one quantity, of this and of other fields, have one unit and may be
  /// added up.
  BalanceRows(Assembly& assembly, const Field& row, const std::string& quantity);
  /// For parts that add terms to the rows of another part. Where the owner has declared no balances, only the residual
  /// changes.
  BalanceRows(Assembly& assembly, const Field& row);

  /// residual += amounts that each row stores in the step. `largest`: a bound of the numbers whose differences these
  /// amounts are; such numbers leave round-off of their own size.
  void store(const Vector& amounts, double largest = 0);
  /// residual −= amounts that sources bring in from outside of all balances.
  void supply(const Vector& amounts);
  /// residual += outflow from each row to others. The sum of `leaving` is what the sum of `outflow` would be without
  /// round-off: the amount that leaves all rows of the quantity together. `largest`: as in `store`, for each row; it
  /// does not count for the sum.
  void exchange(const Vector& outflow, const Vector& leaving, double largest = 0);
  /// Adds to the throughput the amounts that other terms of these rows (by Assembly::linear, say) store, bring in or
  /// let out; their sign does not matter.
  void add_throughput(const Vector& amounts);

 private:
  Assembly& assembly_;
  const Field& row_;
  int unknown_;  ///< none where the rows are not in the solve
};

}  // namespace sprekk
