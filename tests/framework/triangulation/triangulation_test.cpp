#include "framework/triangulation/triangulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/mesh/plane/planar.hpp"

namespace sprekk::test {
namespace {

constexpr double degree = std::numbers::pi / 180;

double area(const Triangulation& t) {
  double sum = 0;
  for (const auto& [a, b, c] : t.triangles) sum += signed_area(t.points[a], t.points[b], t.points[c]);
  return sum;
}

TEST(Triangulation, FlipsALongDiagonal) {
  Triangulation t{.points = {{0, 0}, {2, -0.3}, {4, 0}, {2, 0.3}},
                  .is_fixed = {true, true, true, true},
                  .triangles = {{0, 1, 2}, {0, 2, 3}},
                  .fixed_edges = {{{0, 1}, false}, {{1, 2}, false}, {{2, 3}, false}, {{3, 0}, false}}};
  const double before = smallest_angle(t);
  improve(t);
  // The short diagonal: the corners at the ends are 2 atan(0.15).
  EXPECT_NEAR(smallest_angle(t), 2 * std::atan(0.15), 1e-14);
  EXPECT_GT(smallest_angle(t), before);
  // A fixed diagonal stays.
  t.triangles = {{0, 1, 2}, {0, 2, 3}};
  t.fixed_edges.push_back({{0, 2}, false});
  improve(t);
  EXPECT_EQ(smallest_angle(t), before);
}

TEST(Triangulation, MovesAPointToTheMiddle) {
  Triangulation t;
  for (int k = 0; k < 6; ++k) t.points.emplace_back(std::cos(60 * k * degree), std::sin(60 * k * degree));
  t.points.emplace_back(0.6, 0.5);
  t.is_fixed = {true, true, true, true, true, true, false};
  for (int k = 0; k < 6; ++k) {
    t.triangles.push_back({k, (k + 1) % 6, 6});
    t.fixed_edges.push_back({{k, (k + 1) % 6}, false});
  }
  const double before = area(t);
  improve(t);
  EXPECT_GE(smallest_angle(t), 50 * degree);
  EXPECT_NEAR(area(t), before, 1e-14);
}

TEST(Triangulation, DividesCornersBetweenBarriers) {
  // A square whose lower left corner is one triangle between two barriers: a flip cures it.
  Triangulation t{.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                  .is_fixed = {true, true, true, true},
                  .triangles = {{0, 1, 3}, {1, 2, 3}},
                  .fixed_edges = {{{0, 1}, true}, {{1, 2}, false}, {{2, 3}, false}, {{3, 0}, true}}};
  EXPECT_EQ(single_corner_count(t), 1);
  improve(t);
  EXPECT_EQ(single_corner_count(t), 0);
  EXPECT_EQ(t.triangles.size(), 2u);
  // With barriers all around no flip helps: the diagonal gets a point.
  t.triangles = {{0, 1, 3}, {1, 2, 3}};
  for (auto& edge : t.fixed_edges) edge.is_barrier = true;
  EXPECT_EQ(single_corner_count(t), 2);
  improve(t);
  EXPECT_EQ(single_corner_count(t), 0);
  EXPECT_EQ(t.triangles.size(), 4u);
  EXPECT_EQ(t.is_fixed.size(), t.points.size());
  EXPECT_NEAR(area(t), 1, 1e-15);
}

TEST(Triangulation, HalvesAFixedDiagonalInPlace) {
  Triangulation t{.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                  .is_fixed = {true, true, true, true},
                  .triangles = {{0, 1, 3}, {1, 2, 3}},
                  .fixed_edges = {{{0, 1}, true}, {{1, 2}, false}, {{2, 3}, false}, {{3, 0}, true}, {{1, 3}, false}}};
  improve(t);
  ASSERT_EQ(t.points.size(), 5u);
  EXPECT_EQ(t.points[4], Point(0.5, 0.5));
  EXPECT_TRUE(t.is_fixed[4]);
  EXPECT_EQ(t.fixed_edges.size(), 6u);
  EXPECT_EQ(single_corner_count(t), 0);
}

}  // namespace
}  // namespace sprekk::test
