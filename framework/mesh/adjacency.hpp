// A list of lists in two arrays: the items of entity i are items[offsets[i]] … items[offsets[i+1]-1].
#pragma once

#include <span>
#include <vector>

namespace sprekk {

/// Lists of integers, one for each entity, in compressed form.
struct Adjacency {
  std::vector<int> offsets{0};
  std::vector<int> items;

  int size() const { return static_cast<int>(offsets.size()) - 1; }
  std::span<const int> operator[](int i) const {
    return {items.data() + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])};
  }

  /// Adds the list of a new entity: the given items, in ascending order and each once. Sorts `some`.
  void append_set(std::vector<int>& some);
};

}  // namespace sprekk
