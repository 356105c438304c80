// The interface of a part that lets balances keep their amounts while other fields are solved for.
#pragma once

#include <string>
#include <vector>

#include "framework/field/field.hpp"

namespace sprekk {

/// A part that names fields which, while they wait for the solve of other fields, are taken to change so that each of
/// their balances keeps the amount that it stores (HeldAmounts).
class HoldsAmounts {
 public:
  virtual ~HoldsAmounts() = default;
  /// The fields of a stabilization. Throws InputError where a balance stores nothing by itself: then no change of the
  /// field would keep its amount.
  virtual std::vector<const Field*> holds_amounts_of(const std::string& stabilization) const = 0;
};

}  // namespace sprekk
