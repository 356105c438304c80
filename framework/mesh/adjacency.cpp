#include "framework/mesh/adjacency.hpp"

#include <algorithm>

namespace sprekk {

void Adjacency::append_set(std::vector<int>& some) {
  std::sort(some.begin(), some.end());
  items.insert(items.end(), some.begin(), std::unique(some.begin(), some.end()));
  offsets.push_back(static_cast<int>(items.size()));
}

}  // namespace sprekk
