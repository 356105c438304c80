// What remains of balances after the last pass of an iteration.
#pragma once

#include <functional>

#include "framework/assembly/assembly.hpp"

namespace sprekk {

/// The residuals of the balances of `row`, one an entity; zero where `counts` is false. They are corrected so that
/// their sum is that without the exchange between rows, whose round-off is no amount. All processes get all values.
/// Collective.
Vector rest_of_balances(const Assembly& assembly, const Field& row, const Mesh& mesh,
                        const std::function<bool(int)>& counts);

}  // namespace sprekk
