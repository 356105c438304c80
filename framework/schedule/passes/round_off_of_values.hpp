// By how much round-off alone changes values from pass to pass.
#pragma once

#include "framework/assembly/assembly.hpp"
#include "framework/assembly/block_system.hpp"

namespace sprekk {

/// For each value x_i of a system, of which A are the derivatives: a small multiple of machine epsilon times
/// (sum over j of |A_ij x_j|)/|A_ii|; 0 where A_ii is 0. A flux along a fracture in which the pressure is the same
/// everywhere is a difference of equal numbers, and all of its digits are round-off. `assembly` has derivatives.
/// Collective; the same on all processes.
Vector round_off_of_values(const Assembly& assembly, const BlockSystem& system);

}  // namespace sprekk
