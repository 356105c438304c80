// Sums of cumulative balances over the mesh.
#pragma once

#include "framework/assembly/part.hpp"

namespace sprekk {

/// Adds the totals of a cumulative field, (stored, outflow) or (stored, injected, outflow) of each entity, each as its
/// owner has it. Collective.
void add_totals(Balance& balance, const Mesh& mesh, const Field& cumulative);

}  // namespace sprekk
