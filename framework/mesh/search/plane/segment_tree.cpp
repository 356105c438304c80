#include "framework/mesh/search/plane/segment_tree.hpp"

#include <algorithm>
#include <numeric>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

SegmentTree::Extent SegmentTree::extent_of(const Segment& segment) {
  return {segment.from.cwiseMin(segment.to), segment.from.cwiseMax(segment.to)};
}

SegmentTree::SegmentTree(const std::vector<Segment>& segments) : order_(segments.size()) {
  if (segments.empty()) return;
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Extent> extents;
  for (const Segment& segment : segments) extents.push_back(extent_of(segment));
  grow(0, static_cast<int>(segments.size()), extents);
  for (const int segment : order_) extents_.push_back(extents[segment]);
}

int SegmentTree::grow(int first, int last, const std::vector<Extent>& extents) {
  constexpr int in_a_leaf = 4;  // segments that are looked at one by one
  const int branch = static_cast<int>(branches_.size());
  Extent whole = extents[order_[first]];
  for (int i = first + 1; i < last; ++i) whole = whole.joined(extents[order_[i]]);
  branches_.push_back({whole, first, last, none});
  if (last - first <= in_a_leaf) return branch;
  const Point size = whole.high - whole.low;
  const int axis = size.x() >= size.y() ? 0 : 1;
  const int middle = first + (last - first) / 2;
  const auto center = [&](int segment) { return extents[segment].low[axis] + extents[segment].high[axis]; };
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](int a, int b) { return center(a) < center(b); });
  grow(first, middle, extents);
  const int second = grow(middle, last, extents);
  branches_[branch].second_child = second;
  return branch;
}

std::vector<int> SegmentTree::near(const Segment& place, double reach) const {
  std::vector<int> found;
  if (branches_.empty()) return found;
  Extent wanted = extent_of(place);
  wanted.low.array() -= reach;
  wanted.high.array() += reach;
  std::vector<int> waiting = {0};
  while (!waiting.empty()) {
    const int number = waiting.back();
    const Branch& branch = branches_[number];
    waiting.pop_back();
    if (!branch.extent.meets(wanted)) continue;
    if (branch.second_child != none) {
      waiting.insert(waiting.end(), {number + 1, branch.second_child});
      continue;
    }
    for (int i = branch.first; i < branch.last; ++i)
      if (extents_[i].meets(wanted)) found.push_back(order_[i]);
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace sprekk
