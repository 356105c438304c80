// Places beside the arc of a last segment on the coarse level, where the segment is the chord of the arc.
#include "components/fine_fracture/tips/beside_arcs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace sprekk::fine_fracture {
namespace {

/// An arc of 0.8 m with a height of 0.1 m in a square, turned, mirrored or perturbed.
struct Scene {
  double turn = 0, mirror = 1, factor = 1;

  Point at(double along, double across) const {
    const double x = factor * along, y = mirror * across;
    return {2 + std::cos(turn) * x - std::sin(turn) * y, 1 + std::sin(turn) * x + std::cos(turn) * y};
  }
  BesideArcs arcs() const {
    BesideArcs arcs;
    arcs.add(at(0, 0), at(0.5, 0.1), at(0.8, 0));
    return arcs;
  }
  std::vector<Point> outline() const {
    const std::vector<Point> turning = {at(-2, -2), at(2, -2), at(2, 2), at(-2, 2)};
    return mirror > 0 ? turning : std::vector<Point>(turning.rbegin(), turning.rend());
  }
  Point moved(double along, double across) const { return arcs().on_coarse_level({at(along, across)}, outline())[0]; }
};

const std::vector<Scene> scenes = {{}, {0.7}, {2.4}, {0, -1}, {0.7, -1}, {0.7, 1, 1 + 1e-9}};

TEST(BesideArcs, TheArcLiesOnTheChordAndTheRestOnItsSide) {
  for (const Scene& scene : scenes)
    for (double along = 0.01; along < 0.8; along += 0.03) {
      const double height = along < 0.5 ? 0.1 * along / 0.5 : 0.1 * (0.8 - along) / 0.3;
      EXPECT_EQ(scene.moved(along, height), scene.at(along, height)) << "on the arc: " << along;
      for (const double beside : {1e-6, 0.01, 0.05, 0.2, 0.25}) {
        // From the arc (0) to the rim (0.4) in proportion.
        const double above = height + beside, below = height - beside;
        EXPECT_NEAR((scene.moved(along, above) - scene.at(along, 0.4 * beside / (0.4 - height))).norm(), 0, 1e-9);
        EXPECT_NEAR((scene.moved(along, below) - scene.at(along, -0.4 * beside / (0.4 + height))).norm(), 0, 1e-9);
      }
    }
}

TEST(BesideArcs, NothingMovesOutsideOfTheStrip) {
  for (const Scene& scene : scenes)
    for (const auto& [along, across] : {std::pair(-0.01, 0.05), std::pair(0.81, 0.05), std::pair(0.4, 0.401),
                                        std::pair(0.4, -0.401), std::pair(1.5, 1.5)})
      EXPECT_EQ(scene.moved(along, across), scene.at(along, across)) << along << ' ' << across;
}

TEST(BesideArcs, PlacesMoveContinuously) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-0.6, 1.2);
  constexpr double apart = 1e-4, steepest = 2;  // a strip of 0.4 m becomes one of 0.3 or 0.5 m, and heights rise by 1/3
  for (const Scene& scene : scenes)
    for (int i = 0; i < 2000; ++i) {
      const double along = any(random), across = any(random), direction = 10 * any(random);
      const Point step = scene.moved(along + apart * std::cos(direction), across + apart * std::sin(direction)) -
                         scene.moved(along, across);
      ASSERT_LT(step.norm(), steepest * apart) << along << ' ' << across;
    }
}

TEST(BesideArcs, NoPlaceLeavesTheOutline) {
  const Scene scene;
  const std::vector<Point> outline = {scene.at(-2, -0.15), scene.at(2, -0.15), scene.at(2, 2), scene.at(-2, 2)};
  for (double across = -0.15; across < 0.4; across += 0.001) {
    const Point there = scene.arcs().on_coarse_level({scene.at(0.5, across)}, outline)[0];
    EXPECT_GE(there.y(), 1 - 0.15);
  }
}

TEST(BesideArcs, AStraightSegmentAndOneThatTurnsBackMoveNothing) {
  const Scene scene;
  BesideArcs arcs;
  arcs.add(scene.at(0, 0), scene.at(0.5, 0), scene.at(0.8, 0));
  arcs.add(scene.at(0, 0), scene.at(1.1, 0.3), scene.at(0.8, 0));
  for (const double across : {-0.1, 0.0, 0.01})
    EXPECT_EQ(arcs.on_coarse_level({scene.at(0.4, across)}, scene.outline())[0], scene.at(0.4, across));
}

}  // namespace
}  // namespace sprekk::fine_fracture
