// Makes values whole that are distributed over processes. Each value travels once.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "framework/types.hpp"

namespace sprekk::parallel {

/// The values of all processes, one after the other in order of rank. `counts`: how many each process has, which every
/// process knows. Collective.
Vector gathered(const Vector& mine, const std::vector<int>& counts);

/// Gives all processes the bytes, or the values, of the first. Collective.
void broadcast(void* bytes, std::size_t count);
void broadcast(Vector& values);  ///< as many on every process
template <class Value>
requires std::is_trivially_copyable_v<Value>
void broadcast(std::vector<Value>& values) {
  std::size_t count = values.size();
  broadcast(&count, sizeof count);
  values.resize(count);
  broadcast(values.data(), count * sizeof(Value));
}

/// Makes vectors whole whose entries are distributed over processes, always in the same way.
class WholeVectors {
 public:
  WholeVectors() = default;
  /// `mine`: the places of this process's entries in the whole vector, in any order. Each place from 0 to `size` - 1
  /// has one entry on one process; entries with larger places are left out. Collective.
  WholeVectors(const std::vector<int>& mine, int size);
  /// The vector of which this process has the entries `mine`, in their order. Collective.
  Vector whole(const Vector& mine) const;

 private:
  std::vector<int> counts_;  ///< entries of each process
  std::vector<int> places_;  ///< of all entries, in order of rank; -1 for those that are left out
};

}  // namespace sprekk::parallel
