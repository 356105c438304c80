// Which cells of the bulk have to be solved with the fractures, so that the rest of it is held.
#pragma once

#include <vector>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Of every unknown of a system in one process, whether it is one of the bulk that local unknowns alone hold.
///
/// A part of a bulk block is what non-zero entries join. Fractures may enclose one: then nothing in the equations of
/// the bulk holds its level (scalar_elliptic) or its rigid motions in the plane (elasticity), as for a block of rock
/// between fractures. Motions that disturb no balance of the bulk, to half of the digits, lose as many cells as fix
/// them, each with its unknowns of all blocks at the same places: the first where it moves most, the next where what is
/// left moves most. Rows that are sums of balances (LinearSystem::sums) hold nothing here, and their cells come first.
/// Depends on the matrix alone.
std::vector<char> unknowns_that_fractures_hold(const LinearSystem& system);

}  // namespace sprekk
