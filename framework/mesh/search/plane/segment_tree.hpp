// Finds the segments near a place among very many.
#pragma once

#include <vector>

#include "framework/mesh/plane/planar.hpp"

namespace sprekk {

/// A tree of bounding boxes. A search takes time in proportion to the logarithm of the number of segments and to the
/// number of those that it finds.
class SegmentTree {
 public:
  explicit SegmentTree(const std::vector<Segment>& segments);

  /// The numbers of the segments whose bounding box is not farther than `reach` (m) from that of `place`, along either
  /// axis, in ascending order.
  std::vector<int> near(const Segment& place, double reach) const;

 private:
  struct Extent {
    Point low, high;
    Extent joined(const Extent& other) const { return {low.cwiseMin(other.low), high.cwiseMax(other.high)}; }
    bool meets(const Extent& other) const {
      return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
    }
  };
  struct Branch {
    Extent extent;
    int first, last;   ///< of the segments in it, as places in order_
    int second_child;  ///< the first one follows its parent; none for a leaf
  };
  static Extent extent_of(const Segment& segment);
  int grow(int first, int last, const std::vector<Extent>& extents);

  std::vector<int> order_;
  std::vector<Extent> extents_;  ///< in the order of order_
  std::vector<Branch> branches_;
};

}  // namespace sprekk
