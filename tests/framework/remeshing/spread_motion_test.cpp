#include "framework/remeshing/spread_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sprekk {
namespace {

TEST(SpreadMotion, MeansOfNeighbours) {
  // Two nodes in a row between one that is moved and one at rest; edges of lengths 1, 2, 4: their middles are
  // 1/2, 2 and 5 away from the moved node, so steps are in these proportions.
  const std::vector<Point> nodes{{0, 0}, {1, 0}, {3, 0}, {7, 0}};
  const std::vector<std::array<int, 2>> edges{{0, 1}, {2, 1}, {2, 3}};
  const std::vector<bool> is_at_rest{false, false, false, true};
  const Point by(0.3, -0.15);
  const auto motion = spread_motion(nodes, edges, is_at_rest, {{0, by}});
  EXPECT_EQ(motion[0], by);
  EXPECT_NEAR((motion[1] - 7 / 7.5 * by).norm(), 0, 1e-15);
  EXPECT_NEAR((motion[2] - 5 / 7.5 * by).norm(), 0, 1e-15);
  EXPECT_EQ(motion[3], Point(0, 0));
}

TEST(SpreadMotion, FallsLinearlyInARing) {
  // Rings of 24 nodes around the moved one, evenly spaced.
  constexpr int rings = 8, sectors = 24;
  std::vector<Point> nodes{{0, 0}};
  std::vector<std::array<int, 2>> edges;
  std::vector<bool> is_at_rest{false};
  for (int ring = 1; ring <= rings; ++ring) {
    for (int k = 0; k < sectors; ++k) {
      const double angle = 2 * std::numbers::pi * k / sectors;
      nodes.emplace_back(ring * std::cos(angle), ring * std::sin(angle));
      is_at_rest.push_back(ring == rings);
      const int node = 1 + (ring - 1) * sectors + k;
      edges.push_back({node, ring == 1 ? 0 : node - sectors});
      edges.push_back({node, 1 + (ring - 1) * sectors + (k + 1) % sectors});
    }
  }
  const auto motion = spread_motion(nodes, edges, is_at_rest, {{0, {1, 0}}});
  // With as many edges in each ring the steps are as the distances of their middles: 1, 3, 5 …, a parabola.
  for (int ring = 1; ring <= rings; ++ring)
    EXPECT_NEAR(motion[1 + (ring - 1) * sectors].x(), 1 - ring * ring / 64.0, 1e-14);
}

TEST(SpreadMotion, IsLinearAlsoWhereANodeDoesNotMove) {
  const std::vector<Point> nodes{{0, 0}, {1, 0}, {2, 0.5}, {3, 0}, {1.5, 2}};
  const std::vector<std::array<int, 2>> edges{{0, 1}, {1, 2}, {2, 3}, {1, 4}, {2, 4}};
  const std::vector<bool> is_at_rest{false, false, false, false, true};
  const Point u(0.1, 0.2), v(-0.3, 0.1);
  const auto both = spread_motion(nodes, edges, is_at_rest, {{0, u}, {3, v}});
  const auto first = spread_motion(nodes, edges, is_at_rest, {{0, u}, {3, Point::Zero()}});
  const auto second = spread_motion(nodes, edges, is_at_rest, {{0, Point::Zero()}, {3, v}});
  for (std::size_t node = 0; node < nodes.size(); ++node)
    EXPECT_NEAR((both[node] - first[node] - second[node]).norm(), 0, 1e-16);
  // Equations that are kept give the same bits, whatever was asked for before.
  const SpreadMotion spread(nodes, edges, is_at_rest, {0, 3});
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(spread.of({{0, u}, {3, v}}), both);
    EXPECT_EQ(spread.of({{3, Point::Zero()}, {0, u}}), first);
    EXPECT_EQ(spread.of({{3, v}}), second);
  }
}

TEST(SpreadMotion, RefusesNodesWithoutConnection) {
  EXPECT_THROW(spread_motion({{0, 0}, {1, 0}, {2, 0}}, {{1, 2}}, {false, false, false}, {{0, {1, 0}}}),
               std::runtime_error);
}

}  // namespace
}  // namespace sprekk
