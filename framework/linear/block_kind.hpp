// The kind of the equations of one field, for linear solvers, which know no physics. The declaration of each field
// gives it.
#pragma once

namespace sprekk {

/// The kind of a block of unknowns: how it is solved, and what its near-null space is. Bulk unknowns are factorized
/// once and condensed, or treated by a multigrid cycle; interface unknowns are few, and are solved exactly and last.
enum class BlockKind {
  bulk_elliptic,  ///< one potential in the bulk; near-null space: the constant
  bulk_elastic,   ///< a displacement of the bulk, `dimension` components; near-null space: rigid-body motions
  interface,      ///< on interfaces (fractures and their walls): solved exactly, its constant modes by sums of balances
};

/// Whether the unknowns are on entities of the rock.
constexpr bool is_bulk(BlockKind kind) { return kind != BlockKind::interface; }

}  // namespace sprekk
