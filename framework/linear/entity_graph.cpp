#include "framework/linear/entity_graph.hpp"

#include <algorithm>

#include "framework/invariants.hpp"

namespace sprekk {

EntityGraph::EntityGraph(const SparseMatrix& matrix, const std::vector<UnknownBlock>& blocks) {
  std::vector<int> entity_of(matrix.cols(), -1);
  std::vector<int> first_entity(blocks.size());
  int entities = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const UnknownBlock& block = blocks[b];
    const auto same_places = std::find_if(blocks.begin(), blocks.begin() + b,
                                          [&](const UnknownBlock& other) { return block.is_at_places_of(other); });
    const bool is_new = same_places == blocks.begin() + b;
    first_entity[b] = is_new ? entities : first_entity[same_places - blocks.begin()];
    if (is_new) entities += block.entities;
    for (int i = 0; i < block.entities * block.components; ++i)
      entity_of[block.first + i] = first_entity[b] + i / block.components;
    SPREKK_EXPECT(block.first + block.entities * block.components <= matrix.cols(), block.name, matrix.cols());
  }
  for (int& entity : entity_of)
    if (entity < 0) entity = entities++;
  unknowns_.resize(entities);
  for (int i = 0; i < static_cast<int>(entity_of.size()); ++i) unknowns_[entity_of[i]].push_back(i);
  std::vector<int> seen_by(entities, -1);
  starts_ = {0};
  for (int entity = 0; entity < entities; ++entity) {
    for (const int unknown : unknowns_[entity])
      for (SparseMatrix::InnerIterator entry(matrix, unknown); entry; ++entry) {
        const int other = entity_of[entry.col()];
        if (seen_by[other] == entity) continue;
        seen_by[other] = entity;
        neighbours_.push_back(other);
      }
    std::sort(neighbours_.begin() + starts_.back(), neighbours_.end());
    starts_.push_back(static_cast<int>(neighbours_.size()));
  }
}

std::vector<int> EntityGraph::unknowns_in_order(const std::vector<int>& entities) const {
  SPREKK_EXPECT(entities.size() == unknowns_.size(), entities.size(), unknowns_.size());
  SPREKK_EXPECT(are_indices(entities, static_cast<long>(unknowns_.size())), unknowns_.size());
  std::vector<int> order;
  for (const int entity : entities) order.insert(order.end(), unknowns_[entity].begin(), unknowns_[entity].end());
  return order;
}

}  // namespace sprekk
