#include "framework/mesh/plane/planar.hpp"

#include "framework/meshing/plane/arrangement.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

TEST(Planar, DistanceBetweenSegments) {
  const Segment a{{0, 0}, {2, 0}};
  EXPECT_DOUBLE_EQ(distance(a, Segment{{1, -1}, {1, 1}}), 0);
  EXPECT_DOUBLE_EQ(distance(a, Segment{{0, 1}, {2, 1}}), 1);
  EXPECT_DOUBLE_EQ(distance(a, Segment{{3, 0}, {4, 0}}), 1);
  EXPECT_DOUBLE_EQ(distance(a, Segment{{5, 4}, {8, 8}}), 5);
  EXPECT_DOUBLE_EQ(distance(a, Segment{{1, 0}, {4, 0}}), 0);
}

TEST(Planar, PolygonAreaAndInside) {
  const std::vector<Point> notched{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
  EXPECT_DOUBLE_EQ(signed_area(notched), 10);
  EXPECT_TRUE(is_inside({0.5, 2}, notched));
  EXPECT_FALSE(is_inside({2, 2}, notched));
  EXPECT_FALSE(is_inside({5, 1}, notched));
}

TEST(Planar, SmallestAngle) {
  EXPECT_NEAR(smallest_angle({0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}), 60 * degree, 1e-15);
  EXPECT_NEAR(smallest_angle({0, 0}, {2, 0}, {0, 2}), 45 * degree, 1e-15);
  EXPECT_LT(smallest_angle({0, 0}, {0, 2}, {2, 0}), 0);
}

TEST(Arrangement, CutsCrossingTouchingAndOverlappingSegments) {
  const Arrangement cut = arrange({{{0, 0}, {4, 0}},   // the one that the others meet
                                   {{1, -1}, {1, 1}},  // crosses
                                   {{2, 0}, {2, 3}},   // touches
                                   {{5, 0}, {3, 0}}},  // overlaps, backwards
                                  1e-9);
  const auto positions = [&](int segment) {
    std::vector<Point> points;
    for (const int p : cut.chains[segment]) points.push_back(cut.points[p]);
    return points;
  };
  EXPECT_EQ(positions(0), (std::vector<Point>{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}}));
  EXPECT_EQ(positions(1), (std::vector<Point>{{1, -1}, {1, 0}, {1, 1}}));
  EXPECT_EQ(positions(2), (std::vector<Point>{{2, 0}, {2, 3}}));
  EXPECT_EQ(positions(3), (std::vector<Point>{{5, 0}, {4, 0}, {3, 0}}));
  EXPECT_EQ(cut.chains[0][4], cut.chains[3][1]);
}

}  // namespace
}  // namespace sprekk::test
