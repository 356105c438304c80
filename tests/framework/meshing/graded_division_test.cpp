#include <cmath>

#include "framework/meshing/plane/graded_division.hpp"

#include <gtest/gtest.h>

namespace sprekk::test {
namespace {

TEST(GradedDivision, ConstantSizeGivesEqualEdges) {
  const Segment segment{{1, 2}, {4, 6}};  // 5 m
  for (const auto& [size, edges] : {std::pair(5., 1), {4., 1}, {2.4, 2}, {1., 5}, {0.5, 10}}) {
    const auto points = graded_division(segment, [size = size](const Point&) { return size; });
    ASSERT_EQ(static_cast<int>(points.size()), edges - 1);
    for (int k = 1; k < edges; ++k) {
      EXPECT_NEAR((points[k - 1] - Point(1 + 3. * k / edges, 2 + 4. * k / edges)).norm(), 0, 1e-14);
    }
  }
}

TEST(GradedDivision, LinearSizeGivesAGeometricSeries) {
  // h = 0.1 + 0.5 x on (0, 1): the n-th of N points is at 0.2 (6^(n/N) - 1), N the nearest integer to 2 ln 6.
  const auto points = graded_division({{0, 0}, {1, 0}}, [](const Point& x) { return 0.1 + 0.5 * x.x(); });
  ASSERT_EQ(points.size(), 3u);
  for (int n = 1; n < 4; ++n) EXPECT_NEAR(points[n - 1].x(), 0.2 * (std::pow(6., n / 4.) - 1), 2e-3);
}

}  // namespace
}  // namespace sprekk::test
