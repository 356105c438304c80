// Which cells of the bulk have to be solved with the fractures, so that the rest of the bulk is not singular.
#pragma once

#include <vector>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// For every unknown of a system: whether it belongs to the bulk, but has to be solved with the local unknowns, since
/// the rest of the bulk would be singular. Non-zero entries join the entities of a bulk block to connected parts.
/// Fractures may enclose such a part. Then the equations of the bulk alone leave a null space: a constant
/// (bulk_elliptic), or the rigid motions (bulk_elastic). For each mode that the equations of the bulk map to zero (to
/// half of the digits), one cell is taken out of the bulk, with its unknowns of all blocks at the same place: first the
/// cell where the mode is largest, then that where the remaining modes are largest. Rows that are sums of balances
/// (LinearSystem::sums) do not count as equations that determine a mode, and their cells are taken first. The result
/// depends on the matrix alone, and is the same on all processes. Collective.
std::vector<char> unknowns_held_by_fractures(const LinearSystem& system);

}  // namespace sprekk
