// The graph of the entities that carry unknowns, as input of a fill-reducing ordering.
#pragma once

#include <vector>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// The sparsity graph of a matrix with the unknowns of each entity (pressure and displacement of a cell, say) merged
/// into one vertex. These unknowns have nearly the same neighbours. So an ordering of entities, each with its unknowns
/// one after the other, has as little fill-in as an ordering of single unknowns, and is found in a fraction of the
/// time.
class EntityGraph {
 public:
  /// Fields whose entities are at the same places, in the same order, share their entities; an unknown
  /// in no block is an entity of its own. One process.
  EntityGraph(const SparseMatrix& matrix, const std::vector<UnknownBlock>& blocks);

  int size() const { return static_cast<int>(starts_.size()) - 1; }
  /// The neighbours of entity i are neighbours()[starts()[i]] … [starts()[i + 1] - 1], ascending.
  const std::vector<int>& starts() const { return starts_; }
  const std::vector<int>& neighbours() const { return neighbours_; }
  /// The unknowns in the order of their entities: the inverse of a numbering.
  std::vector<int> unknowns_in_order(const std::vector<int>& entities) const;

 private:
  std::vector<std::vector<int>> unknowns_;  ///< of every entity, ascending
  std::vector<int> starts_, neighbours_;
};

}  // namespace sprekk
