// Parts that offer stabilizations.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/field/field.hpp"

namespace sprekk {

/// The diagonals that stabilize a split (see SolveStep): residual(row) += diagonal · (value − value at the solve's
/// start).
using Stabilization = std::map<const Field*, Vector>;

/// Capability: a part that approximates Schur complements of its blocks by diagonals.
class Stabilizes {
 public:
  virtual ~Stabilizes() = default;
  /// The names of the stabilizations that the part offers to split schemes.
  virtual std::vector<std::string> stabilizations() const = 0;
  /// Adds the diagonals of a named stabilization for the fields that the part can stabilize; none for other names.
  virtual void stabilize(const std::string& /*scheme*/, Stabilization&) const {}
  /// The fields that, while they wait in a solve of other fields with this stabilization, are assumed to change so that
  /// each of their balances keeps the amount that it stores (HeldAmounts). Throws InputError where a balance stores
  /// nothing by itself: then no change of the field would keep its amount.
  virtual std::vector<const Field*> holds_amounts_of(const std::string& /*scheme*/) const { return {}; }
  /// Adds diagonals that bring the blocks of fields near to their Schur complements, for iterative solvers. They change
  /// no answer.
  virtual void stabilize_preconditioner(Stabilization&) const {}
};

}  // namespace sprekk
