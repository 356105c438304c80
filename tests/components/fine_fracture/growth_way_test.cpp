// Where a tip was while its last segment turned and grew: places on known curves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "components/fine_fracture/growth/way_of_tip.hpp"

namespace sprekk::fine_fracture {
namespace {

const Point anchor(0.3, -0.2);

Point at(double length, double angle) { return anchor + length * Point(std::cos(angle), std::sin(angle)); }

/// A spiral, on which the direction from the anchor is linear in the distance, in any orientation and both senses.
TEST(WayOfTip, IsExactWhereTheDirectionIsLinearInTheDistance) {
  for (const double turned : {0.0, 0.7, 2.9, 3.14159, -1.3})
    for (const double bend : {4.0, -7.0}) {
      const auto on_spiral = [&](double length) { return at(length, turned + bend * length); };
      const std::vector<Point> way = {on_spiral(4e-3), on_spiral(9e-3), on_spiral(9.5e-3), on_spiral(17e-3)};
      for (const double length : {4e-3, 6e-3, 9e-3, 9.2e-3, 12e-3, 17e-3})
        EXPECT_LT((place_on_way(anchor, way, length) - on_spiral(length)).norm(), 1e-15) << turned << " " << length;
      // Up to the first place the segment is straight.
      EXPECT_LT((place_on_way(anchor, way, 1e-3) - at(1e-3, turned + bend * 4e-3)).norm(), 1e-15);
    }
}

/// On a circle the error falls with the square of the distances between places.
TEST(WayOfTip, IsOfSecondOrderOnACurve) {
  const double radius = 0.02;
  const auto on_curve = [&](double length) { return at(length, std::pow(length / radius, 1.5)); };
  std::vector<double> errors;
  for (const int steps : {2, 4, 8}) {
    std::vector<Point> way;
    for (int i = 0; i <= steps; ++i) way.push_back(on_curve(8e-3 + 8e-3 * i / steps));
    double worst = 0;
    for (double length = 8e-3; length < 16e-3; length += 0.05e-3)
      worst = std::max(worst, (place_on_way(anchor, way, length) - on_curve(length)).norm());
    errors.push_back(worst);
  }
  EXPECT_GT(errors[0] / errors[1], 3.5);
  EXPECT_GT(errors[1] / errors[2], 3.5);
}

}  // namespace
}  // namespace sprekk::fine_fracture
