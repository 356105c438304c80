// Sets of numbers that are joined.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace sprekk {

/// The numbers from 0 on, at first each in a set of its own.
class JoinedSets {
 public:
  explicit JoinedSets(int count) : root_(count) { std::iota(root_.begin(), root_.end(), 0); }
  /// The smallest number of the set of i, whatever the order in which sets were joined.
  int root(int i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }
  void join(int i, int j) {
    const auto [low, high] = std::minmax({root(i), root(j)});
    root_[high] = low;
  }

 private:
  std::vector<int> root_;
};

}  // namespace sprekk
