#include "framework/mesh/search/plane/segment_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace sprekk::test {
namespace {

std::vector<Segment> drawn(int count, double length) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1, 1);
  std::vector<Segment> segments;
  for (int i = 0; i < count; ++i) {
    const Point from(place(random), place(random));
    segments.push_back({from, from + length * Point(place(random), place(random))});
  }
  return segments;
}

TEST(SegmentTree, FindsAllThatAreNear) {
  for (const int count : {1, 2, 5, 300})
    for (const double length : {0.0, 0.05, 2.0}) {
      const std::vector<Segment> segments = drawn(count, length);
      const SegmentTree tree(segments);
      for (const double reach : {0.0, 0.02, 0.3})
        for (const Segment& place : segments) {
          const std::vector<int> found = tree.near(place, reach);
          EXPECT_TRUE(std::ranges::is_sorted(found));
          for (int i = 0; i < count; ++i) {
            const bool is_near = distance(segments[i], place) < reach;
            EXPECT_TRUE(!is_near || std::ranges::binary_search(found, i));
          }
        }
    }
}

TEST(SegmentTree, FindsOnlyWhatIsNear) {
  const std::vector<Segment> segments = drawn(10'000, 0.001);
  const SegmentTree tree(segments);
  for (int i = 0; i < 100; ++i) {
    const std::vector<int> found = tree.near(segments[i], 0.01);
    for (const int j : found) EXPECT_LT((segments[i].from - segments[j].from).cwiseAbs().maxCoeff(), 0.01 + 2 * 0.001);
  }
}

TEST(SegmentTree, IsEmptyWithoutSegments) { EXPECT_TRUE(SegmentTree({}).near({{0, 0}, {1, 1}}, 10).empty()); }

}  // namespace
}  // namespace sprekk::test
