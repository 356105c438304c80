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
      const Point start = at(1, turned) - anchor;
      std::vector<PlaceOnWay> way;
      for (const double length : {4e-3, 9e-3, 9.5e-3, 17e-3}) way.push_back({on_spiral(length), start});
      for (const double length : {4e-3, 6e-3, 9e-3, 9.2e-3, 12e-3, 17e-3})
        EXPECT_LT((place_on_way(anchor, way, length).position - on_spiral(length)).norm(), 1e-15) << turned;
      // Up to the first place the segment is straight.
      EXPECT_LT((place_on_way(anchor, way, 1e-3).position - at(1e-3, turned + bend * 4e-3)).norm(), 1e-15);
    }
}

/// A circle that begins at the anchor in some direction, and its direction after an arc.
struct Circle {
  double curvature, begins;
  double angle(double arc) const { return begins + curvature * arc; }
  PlaceOnWay after(double arc) const {
    return {anchor + (Point(std::sin(angle(arc)), -std::cos(angle(arc))) - Point(std::sin(begins), -std::cos(begins))) /
                         curvature,
            {std::cos(angle(arc)), std::sin(angle(arc))}};
  }
};

/// On a circle the place is exact but for the third order, and so is the direction but for the second one.
TEST(WayOfTip, IsOfSecondOrderOnACircle) {
  for (const Circle circle : {Circle{40, 3.0}, Circle{-25, -0.4}}) {
    std::vector<double> places, directions;
    for (const int steps : {4, 8, 16, 32}) {
      std::vector<PlaceOnWay> way;
      for (int i = 1; i <= steps; ++i) way.push_back(circle.after(16e-3 * i / steps));
      double worst = 0, most = 0;
      for (double arc = 4.01e-3; arc < 15.9e-3; arc += 0.05e-3) {
        const PlaceOnWay exact = circle.after(arc);
        const PlaceOnWay found = place_on_way(anchor, way, (exact.position - anchor).norm());
        worst = std::max(worst, (found.position - exact.position).norm());
        most = std::max(most, (found.direction - exact.direction).norm());
      }
      places.push_back(worst);
      directions.push_back(most);
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_GT(places[i] / places[i + 1], 3.4) << i;
      EXPECT_GT(directions[i] / directions[i + 1], 3.4) << i;
    }
  }
}

TEST(CornersOfArc, BelongToTangentsOfACircle) {
  for (const Circle circle : {Circle{40, 3.0}, Circle{-25, -0.4}, Circle{1e-4, 0.2}}) {
    const PlaceOnWay start = circle.after(0), end = circle.after(0.012);
    const std::vector<Point> corners = corners_of_arc(anchor, start.direction, end.position);
    const int count = static_cast<int>(corners.size());
    ASSERT_GE(count, 3);
    EXPECT_LT(((corners[0] - anchor).normalized() - start.direction).norm(), 1e-6);
    EXPECT_LT(((end.position - corners.back()).normalized() - end.direction).norm(), 1e-6);
    EXPECT_NEAR((corners[0] - anchor).norm(), (end.position - corners.back()).norm(), 1e-9);
    for (int i = 0; i + 1 < count; ++i) {
      const PlaceOnWay touched = circle.after(0.012 * (i + 1) / count);
      EXPECT_LT((0.5 * (corners[i] + corners[i + 1]) - touched.position).norm(), 1e-9);
      EXPECT_LT(((corners[i + 1] - corners[i]).normalized() - touched.direction).norm(), 1e-6);
      EXPECT_NEAR((corners[i + 1] - corners[i]).norm(), 2 * (corners[0] - anchor).norm(), 1e-9);
    }
  }
}

/// An arc is divided on itself: its parts have the directions of the whole one at all ends.
TEST(PlaceOnArc, LiesOnTheCircleWithItsDirection) {
  for (const Circle circle : {Circle{40, 3.0}, Circle{-25, -0.4}, Circle{1e-4, 0.2}}) {
    const PlaceOnWay start = circle.after(0), end = circle.after(0.02);
    EXPECT_LT((place_on_arc(anchor, start.direction, end.position, 0.0).direction - start.direction).norm(), 1e-10);
    for (const double arc : {0.003, 0.011, 0.0199}) {
      const PlaceOnWay exact = circle.after(arc);
      const PlaceOnWay found = place_on_arc(anchor, start.direction, end.position, (exact.position - anchor).norm());
      EXPECT_LT((found.position - exact.position).norm(), 1e-12);
      EXPECT_LT((found.direction - exact.direction).norm(), 1e-9);
      const double rest = (end.position - found.position).norm();
      EXPECT_LT((place_on_arc(found.position, found.direction, end.position, rest).direction - end.direction).norm(),
                1e-6);
    }
  }
}

/// A start that leads elsewhere: the arc does not become a loop.
TEST(CornersOfArc, TurnByNoMoreThanSoMuch) {
  const Point end = anchor + Point(0.01, 0);
  for (const double angle : {0.5, 1.6, 3.1, -0.6, -2.5}) {
    const std::vector<Point> corners = corners_of_arc(anchor, {std::cos(angle), std::sin(angle)}, end);
    const auto angle_of = [](const Point& way) { return std::atan2(way[1], way[0]); };
    EXPECT_NEAR(angle_of(corners[0] - anchor), std::copysign(0.4, angle), 1e-9);
    EXPECT_NEAR(angle_of(end - corners.back()), -std::copysign(0.4, angle), 1e-9);
  }
}

TEST(CornersOfArc, LieOnTheChordOfOneThatIsStraight) {
  for (const Point& chord : {Point(0.01, 0), Point(0, -0.02), Point(3e-3, 4e-3)}) {
    const std::vector<Point> corners = corners_of_arc(anchor, chord.normalized(), anchor + chord);
    const double count = static_cast<double>(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
      EXPECT_LT((corners[i] - anchor - (i + 0.5) / count * chord).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace sprekk::fine_fracture
