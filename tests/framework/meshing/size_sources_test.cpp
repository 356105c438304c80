#include "framework/meshing/plane/size_sources.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace sprekk::test {
namespace {

/// Against all sources one by one, to the bit; with every number of sources, since trees are joined as they grow.
TEST(SizeSources, GiveTheSmallestSize) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 10), size(0.01, 0.5);
  SizeSources sources;
  for (int i = 0; i < 300; ++i) {
    const Point from(place(random), place(random));
    const Point to = i % 3 == 0 ? from : Point(place(random), place(random));
    sources.add({{from, to}, size(random), i % 2 == 0 ? 0.3 : 0.5});
    ASSERT_EQ(static_cast<int>(sources.all().size()), i + 1);
    for (int k = 0; k < 20; ++k) {
      const Point x(place(random), place(random));
      double expected = 1.5;
      for (const SizeSource& source : sources.all())
        expected = std::min(expected, source.size + source.growth * distance(x, source.segment));
      ASSERT_EQ(sources.lowered(1.5, x), expected);
    }
  }
}

}  // namespace
}  // namespace sprekk::test
