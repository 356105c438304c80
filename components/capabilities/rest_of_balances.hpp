// What passes of an iteration have left of balances.
#pragma once

#include <functional>

#include "framework/assembly/assembly.hpp"

namespace sprekk {

/// The residuals of the balances of `row` in the entities that `counts` names, zero in others; all values are right.
/// Their sum is that without the exchange between rows, whose round-off is no amount. Collective.
Vector rest_of_balances(const Assembly& assembly, const Field& row, const Mesh& mesh,
                        const std::function<bool(int)>& counts);

}  // namespace sprekk
