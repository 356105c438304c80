// Which points of a path the coarse level takes over.
#include "components/fine_fracture/growth/coarse_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

namespace sprekk::test {
namespace {

using namespace fine_fracture;

double length_of(const Point& start, const std::vector<Point>& points) {
  double length = 0;
  Point last = start;
  for (const Point& x : points) length += (x - last).norm(), last = x;
  return length;
}

/// Turned, mirrored, and larger by a trace.
class CoarsePath : public ::testing::TestWithParam<std::tuple<double, double, double>> {
 protected:
  Point at(double x, double y) const {
    const auto [angle, mirror, scale] = GetParam();
    const double c = std::cos(angle), s = std::sin(angle), my = mirror * y;
    return Point(3, -7) + scale * Point(c * x - s * my, s * x + c * my);
  }
  std::vector<Point> path(const std::vector<Point>& points, SharpBends bends = SharpBends::stay) const {
    return coarse_path(at(0, 0), points, 1, bends);
  }
};

TEST_P(CoarsePath, HasNoShortEdgesWhereItHardlyBends) {
  const std::vector<Point> added{at(0.2, 0), at(0.4, 0.02), at(0.7, 0.06), at(0.9, 0.1), at(1.3, 0.2)};
  EXPECT_EQ(path(added), (std::vector{added[2], added[4]}));
  // The end stays, and replaces a point that is too near to it.
  EXPECT_EQ(path({added[0], added[1], added[2], added[3]}), (std::vector{added[3]}));
  EXPECT_EQ(path({added[0]}), (std::vector{added[0]}));
}

TEST_P(CoarsePath, KeepsTheLengthOfWhatHasParted) {
  const std::vector<Point> zigzag{at(0.1, 0.2), at(0.4, 0.1), at(0.6, 0.4)};
  const double length = length_of(at(0, 0), zigzag);
  EXPECT_EQ(path(zigzag), zigzag);
  const std::vector<Point> straight = path(zigzag, SharpBends::are_dropped);
  EXPECT_EQ(straight, (std::vector{zigzag.back()}));
  EXPECT_LT(length_of(at(0, 0), straight), 0.9 * length);
  // An edge of less than a tenth of the coarse size is too short for the mesh.
  EXPECT_EQ(path({at(0.02, 0.06), at(0.8, 0)}), (std::vector{at(0.8, 0)}));
}

INSTANTIATE_TEST_SUITE_P(Directions, CoarsePath,
                         ::testing::Combine(::testing::Values(0.0, 0.7, 2.1, -2.6), ::testing::Values(1.0, -1.0),
                                            ::testing::Values(1.0, 1 + 1e-9)));

}  // namespace
}  // namespace sprekk::test
