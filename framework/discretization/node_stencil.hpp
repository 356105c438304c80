// Sparse matrices whose entries come node by node: their pattern follows from the topology, so that values are added in
// place, without sorting triplets.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "framework/mesh/adjacency.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// The column entities of each row entity: the union of the column entities of its nodes, in ascending order.
class NodeStencil {
 public:
  /// `row_nodes`: for each row entity the nodes that contribute to it. `listed`: for each node its column entities,
  /// ascending.
  NodeStencil(const Adjacency& row_nodes, const Adjacency& listed);

  /// Fills `slots` with the places of the column entities of `node` among those of `row`.
  void find_slots(int row, int node, std::vector<int>& slots) const;

  const Adjacency& columns() const { return columns_; }

 private:
  const Adjacency& listed_;  ///< outlives the stencil
  Adjacency columns_;
};

/// For every entity, the nodes that contribute to its rows: those for which keep(entity, node) holds.
template <class Nodes, class Keep>
Adjacency contributing_nodes(const std::vector<Nodes>& entity_nodes, Keep keep) {
  Adjacency nodes;
  nodes.offsets.reserve(entity_nodes.size() + 1);
  for (std::size_t entity = 0; entity < entity_nodes.size(); ++entity) {
    for (const int node : entity_nodes[entity])
      if (keep(static_cast<int>(entity), node)) nodes.items.push_back(node);
    nodes.offsets.push_back(static_cast<int>(nodes.items.size()));
  }
  return nodes;
}

/// A matrix with `row_components` rows for every row entity and `column_components` columns for every column entity.
class StencilMatrix {
 public:
  /// Zeros in the pattern of the stencil, which must outlive the matrix.
  StencilMatrix(const NodeStencil& stencil, int row_components, int column_entities, int column_components);
  StencilMatrix(const StencilMatrix&) = delete;
  StencilMatrix& operator=(const StencilMatrix&) = delete;

  /// Adds factor * values to component i of a row entity; the values stand entity-major, for the column entities in the
  /// given slots.
  void add(int entity, int i, const std::vector<int>& slots, const double* values, double factor) {
    double* row = row_start(entity, i);
    for (const int slot : slots)
      for (int j = 0; j < column_components_; ++j) row[slot * column_components_ + j] += factor * *values++;
  }
  /// Adds a value in one place: component j of the column entity in the given slot.
  void add(int entity, int i, int slot, int j, double value) {
    row_start(entity, i)[slot * column_components_ + j] += value;
  }

  SparseMatrix take() {
    SparseMatrix taken;
    taken.swap(matrix_);  // to move it would copy it
    return taken;
  }

 private:
  double* row_start(int entity, int i) {
    const std::ptrdiff_t block = row_components_ * column_components_;
    return values_ + block * stencil_.columns().offsets[entity] + i * column_components_ * width(entity);
  }
  int width(int entity) const { return stencil_.columns().offsets[entity + 1] - stencil_.columns().offsets[entity]; }

  const NodeStencil& stencil_;
  int row_components_, column_components_;
  SparseMatrix matrix_;
  double* values_;
};

}  // namespace sprekk
