// Finds conserved amounts that a step has lost.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// The amounts of one conserved quantity in a step, by its equations.
struct StepAmounts {
  double moved = 0;      ///< sum of the absolute amounts that were stored, supplied or let out, place by place
  double round_off = 0;  ///< of the numbers whose differences these amounts are
};

/// A sentence on a balance that is off in the step by more than `tolerance` times the moved amount and more than
/// round-off; "" if all balances hold. The balance is made from the amounts that parts have counted, so it is
/// independent of the residuals that solvers check. `before`, `after`: the totals at the start and at the end of the
/// step. `amounts_of` is called for balances whose totals alone do not show that they hold. Collective.
std::string find_lost_amounts(const std::map<std::string, Balance>& before, const std::map<std::string, Balance>& after,
                              double tolerance, const std::function<StepAmounts(const std::string&)>& amounts_of);

}  // namespace sprekk
