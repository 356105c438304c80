// Which balances of a solve nothing holds: any constant may be added to their potentials.
#pragma once

#include <vector>

#include "framework/assembly/assembly.hpp"

namespace sprekk {

/// The potentials of a connected set of balances to which any constant may be added.
struct FloatingBalances {
  int quantity = 0;  ///< index into Balances::quantities
  int first = 0;     ///< one of its potentials, counted over all unknowns of the assembly
  int balances = 0;  ///< how many there are
};

/// Which floating sets are reported: all (`somewhere`), or only those of a quantity all of whose balances float
/// (`everywhere`). At rest a set that floats beside others keeps its values.
enum class Floating { somewhere, everywhere };

/// All sets of balances whose potentials float in an assembly with derivatives. They are found from what parts declare
/// of their balances (BalanceRows, Operator) and not from a factorization, so they do not depend on solvers and their
/// tolerances.
///
/// Potentials are connected where a row has entries for both. The potentials are the unknowns of the balances, and
/// other scalar unknowns of their unit that have no balances: those on faces, or in a well. A set floats where no row
/// has anything but differences of its potentials: no balance stores, or lets out, an amount that depends on the
/// constant, no other equation responds to it, and none of its values is fixed. `owned`: for every row of every
/// unknown, whether this process owns it. `first`: for every unknown, its first row and column among all. Collective;
/// every process gets the same.
std::vector<FloatingBalances> floating_balances(const Assembly& assembly, const std::vector<std::vector<char>>& owned,
                                                const std::vector<int>& first, Floating told = Floating::somewhere);

}  // namespace sprekk
