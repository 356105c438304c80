// What linear solvers know of the equations of one field. They know no physics: who declares the field says it.
#pragma once

namespace sprekk {

/// Decides who solves for a block, and what its near-null space is. Bulk unknowns are factorized once and condensed, or
/// get a multigrid cycle; interface unknowns are few and are solved exactly, last.
enum class BlockKind {
  bulk_elliptic,  ///< one potential in the bulk; near-null space: the constant
  bulk_elastic,   ///< a displacement of the bulk, `dimension` components; near-null space: rigid-body motions
  interface,      ///< on interfaces (fractures and their walls): solved exactly, its constant modes by sums of balances
};

constexpr bool is_bulk(BlockKind kind) { return kind != BlockKind::interface; }

}  // namespace sprekk
