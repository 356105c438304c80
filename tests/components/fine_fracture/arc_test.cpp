// Arcs in the place of last segments.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "components/fine_fracture/growth/arc.hpp"

namespace sprekk::fine_fracture {
namespace {

const Point anchor(0.3, -0.2);

/// A circle that begins at the anchor in some direction, and its direction after an arc.
struct Circle {
  double curvature, begins;
  double angle(double arc) const { return begins + curvature * arc; }
  PlaceOnPath after(double arc) const {
    return {anchor + (Point(std::sin(angle(arc)), -std::cos(angle(arc))) - Point(std::sin(begins), -std::cos(begins))) /
                         curvature,
            {std::cos(angle(arc)), std::sin(angle(arc))}};
  }
};

TEST(CornersOfArc, BelongToTangentsOfACircle) {
  for (const Circle circle : {Circle{40, 3.0}, Circle{-25, -0.4}, Circle{1e-4, 0.2}}) {
    const PlaceOnPath start = circle.after(0), end = circle.after(0.012);
    const std::vector<Point> corners = corners_of_arc(anchor, start.direction, end.position);
    const int count = static_cast<int>(corners.size());
    ASSERT_GE(count, 2);
    EXPECT_LT(((corners[0] - anchor).normalized() - start.direction).norm(), 1e-6);
    EXPECT_LT(((end.position - corners.back()).normalized() - end.direction).norm(), 1e-6);
    EXPECT_NEAR((corners[0] - anchor).norm(), (end.position - corners.back()).norm(), 1e-9);
    for (int i = 0; i + 1 < count; ++i) {
      const PlaceOnPath touched = circle.after(0.012 * (i + 1) / count);
      EXPECT_LT((0.5 * (corners[i] + corners[i + 1]) - touched.position).norm(), 1e-9);
      EXPECT_LT(((corners[i + 1] - corners[i]).normalized() - touched.direction).norm(), 1e-6);
      EXPECT_NEAR((corners[i + 1] - corners[i]).norm(), 2 * (corners[0] - anchor).norm(), 1e-9);
    }
  }
}

/// An arc is divided on itself: its parts have the directions of the whole one at all ends.
TEST(PlaceOnArc, LiesOnTheCircleWithItsDirection) {
  for (const Circle circle : {Circle{40, 3.0}, Circle{-25, -0.4}, Circle{1e-4, 0.2}}) {
    const PlaceOnPath start = circle.after(0), end = circle.after(0.02);
    EXPECT_LT((place_on_arc(anchor, start.direction, end.position, 0.0).direction - start.direction).norm(), 1e-10);
    for (const double arc : {0.003, 0.011, 0.0199}) {
      const PlaceOnPath exact = circle.after(arc);
      const PlaceOnPath found = place_on_arc(anchor, start.direction, end.position, (exact.position - anchor).norm());
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
