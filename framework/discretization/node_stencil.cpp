#include "framework/discretization/node_stencil.hpp"

#include "framework/invariants.hpp"

namespace sprekk {

NodeStencil::NodeStencil(const Adjacency& row_nodes, const Adjacency& listed) : listed_(listed) {
  columns_.offsets.reserve(row_nodes.size() + 1);
  std::size_t most = 0;
  for (const int node : row_nodes.items) most += listed[node].size();
  columns_.items.reserve(most);
  std::vector<int> unsorted;
  for (int row = 0; row < row_nodes.size(); ++row) {
    unsorted.clear();
    for (const int node : row_nodes[row]) unsorted.insert(unsorted.end(), listed[node].begin(), listed[node].end());
    std::sort(unsorted.begin(), unsorted.end());
    columns_.items.insert(columns_.items.end(), unsorted.begin(), std::unique(unsorted.begin(), unsorted.end()));
    columns_.offsets.push_back(static_cast<int>(columns_.items.size()));
  }
}

void NodeStencil::find_slots(int row, int node, std::vector<int>& slots) const {
  SPREKK_EXPECT(is_index(row, columns_.size()), row, columns_.size());
  SPREKK_EXPECT(is_index(node, listed_.size()), node, listed_.size());
  const auto of_row = columns_[row];
  const auto of_node = listed_[node];
  slots.resize(of_node.size());
  std::size_t slot = 0;
  for (std::size_t i = 0; i < of_node.size(); ++i) {
    SPREKK_ASSERT(slot < of_row.size(), row, node, of_node[i]);
    while (of_row[slot] != of_node[i]) ++slot;
    slots[i] = static_cast<int>(slot);
  }
}

StencilMatrix::StencilMatrix(const NodeStencil& stencil, int row_components, int column_entities, int column_components)
    : stencil_(stencil), row_components_(row_components), column_components_(column_components) {
  SPREKK_EXPECT(row_components > 0 && column_components > 0, row_components, column_components);
  SPREKK_EXPECT(are_indices(stencil.columns().items, column_entities), column_entities);
  const Adjacency& columns = stencil.columns();
  matrix_.resize(row_components * columns.size(), column_components * column_entities);
  const auto entries = static_cast<Eigen::Index>(row_components) * column_components * columns.items.size();
  matrix_.resizeNonZeros(entries);
  values_ = matrix_.valuePtr();
  std::fill_n(values_, entries, 0.0);
  int* row_start = matrix_.outerIndexPtr();
  int* column = matrix_.innerIndexPtr();
  *row_start = 0;
  for (int entity = 0; entity < columns.size(); ++entity)
    for (int i = 0; i < row_components; ++i) {
      for (const int item : columns[entity])
        for (int j = 0; j < column_components; ++j) *column++ = item * column_components + j;
      const int length = column_components * width(entity);
      row_start[1] = row_start[0] + length;
      ++row_start;
    }
}

}  // namespace sprekk
