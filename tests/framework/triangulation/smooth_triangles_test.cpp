#include "framework/triangulation/smooth_triangles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk::test {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct Patch {
  std::vector<Point> points;
  std::vector<Ring> triangles;
  std::vector<char> is_free;

  double area() const {
    double sum = 0;
    for (const Ring& t : triangles) sum += signed_area(points[t[0]], points[t[1]], points[t[2]]);
    return sum;
  }
  double smallest() const {
    double angle = std::numeric_limits<double>::infinity();
    for (const Ring& t : triangles) angle = std::min(angle, smallest_angle(points[t[0]], points[t[1]], points[t[2]]));
    return angle;
  }
};

TEST(SmoothTriangles, MovesAPointToTheMeanOfItsNeighbours) {
  Patch patch;
  for (int k = 0; k < 6; ++k) patch.points.emplace_back(std::cos(60 * k * degree), std::sin(60 * k * degree));
  patch.points.emplace_back(0.3, 0.2);
  patch.is_free = {0, 0, 0, 0, 0, 0, 1};
  for (int k = 0; k < 6; ++k) patch.triangles.push_back({k, (k + 1) % 6, 6});
  smooth_triangles(patch.points, patch.triangles, patch.is_free, 1);
  EXPECT_LT(patch.points[6].norm(), 1e-15);
}

TEST(SmoothTriangles, FlipsAnEdgeUnlessBothEndsAreFixed) {
  const Patch kite{{{0, 0}, {2, -0.3}, {4, 0}, {2, 0.3}}, {{0, 1, 2}, {0, 2, 3}}, {0, 0, 0, 0}};
  Patch fixed = kite;
  smooth_triangles(fixed.points, fixed.triangles, fixed.is_free, 1);
  EXPECT_EQ(fixed.triangles, kite.triangles);
  // Its end at (4, 0) free: the other diagonal, as the corners at the ends of this one are sharp.
  Patch flipped = kite;
  flipped.is_free[2] = 1;
  smooth_triangles(flipped.points, flipped.triangles, flipped.is_free, 1);
  for (const Ring& t : flipped.triangles)
    EXPECT_FALSE(std::count(t.begin(), t.end(), 0) == 1 && std::count(t.begin(), t.end(), 2) == 1);
}

/// Squares with diagonals, disturbed inside by up to `part` of their sides; a line of fixed edges across the middle.
Patch disturbed(int n, double part) {
  Patch patch;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-part / n, part / n);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool is_free = i > 0 && i < n && j > 0 && j < n && j != n / 2;
      const Point x(double(i) / n, double(j) / n);
      patch.points.push_back(is_free ? Point(x + Point(shift(random), shift(random))) : x);
      patch.is_free.push_back(is_free);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      patch.triangles.push_back({a, b, c});
      patch.triangles.push_back({a, c, d});
    }
  return patch;
}

TEST(SmoothTriangles, KeepsAreaAndFixedEdgesAndRaisesTheSmallestAngle) {
  constexpr int n = 20;
  const Patch before = disturbed(n, 0.25);
  ASSERT_GT(before.smallest(), 0);
  ASSERT_LT(before.smallest(), 15 * degree);
  Patch after = before;
  smooth_triangles(after.points, after.triangles, after.is_free, 3);
  // The undisturbed triangles have 45 degrees; those at fixed edges cannot be much better than where they stand.
  EXPECT_GT(after.smallest(), 2 * before.smallest());
  EXPECT_GT(after.smallest(), 20 * degree);
  EXPECT_NEAR(after.area(), 1, 1e-14);
  const FaceTable edges(after.points, after.triangles);
  for (int i = 0; i < n; ++i) {
    const int a = n / 2 * (n + 1) + i;
    EXPECT_NE(edges.find({a, a + 1}), -1);
    EXPECT_EQ(after.points[a], before.points[a]);
  }
}

}  // namespace
}  // namespace sprekk::test
