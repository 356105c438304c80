// Arcs in the place of last segments.
#include <gtest/gtest.h>

#include <cmath>

#include "components/fine_fracture/growth/arc.hpp"
#include "framework/mesh/plane/planar.hpp"

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

/// The integral of the direction over the square root of the distance from the end, of straight pieces and of a circle.
TEST(CornerOfArc, LetsTActAsAlongACircle) {
  for (const Circle circle : {Circle{8, 3.0}, Circle{-5, -0.4}, Circle{0.1, 0.2}}) {
    const double length = 0.012;
    const PlaceOnPath start = circle.after(0), end = circle.after(length);
    const Point corner = corner_of_arc(anchor, start.direction, end.position);
    EXPECT_LT(((end.position - corner).normalized() - end.direction).norm(), 1e-6);
    const double turn = circle.curvature * length, last = (end.position - corner).norm(),
                 whole = last + (corner - anchor).norm();
    EXPECT_NEAR((corner - anchor).norm() / whole, place_of_corner, 0.1 * turn * turn + 1e-12);
    // Angles from that at the start.
    const auto angle = [&](const Point& way) {
      return std::atan2(cross(start.direction, way), start.direction.dot(way));
    };
    const double by_pieces = 2 * (angle(end.position - corner) * std::sqrt(last) +
                                  angle(corner - anchor) * (std::sqrt(whole) - std::sqrt(last))),
                 by_circle = turn * std::sqrt(length) * 4 / 3;
    EXPECT_NEAR(by_pieces / by_circle, 1, 0.1 * turn * turn + 1e-8);
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
TEST(CornerOfArc, TurnsByNoMoreThanSoMuch) {
  const Point end = anchor + Point(0.01, 0);
  for (const double angle : {0.5, 1.6, 3.1, -0.6, -2.5}) {
    const Point last = end - corner_of_arc(anchor, {std::cos(angle), std::sin(angle)}, end);
    EXPECT_NEAR(std::atan2(last[1], last[0]), -std::copysign(0.4, angle), 1e-9);
    EXPECT_NEAR(last.norm(), 0.0025, 1e-12);
  }
}

TEST(CornerOfArc, LiesOnTheChordOfOneThatIsStraight) {
  for (const Point& chord : {Point(0.01, 0), Point(0, -0.02), Point(3e-3, 4e-3)})
    EXPECT_LT((corner_of_arc(anchor, chord.normalized(), anchor + chord) - anchor - 0.75 * chord).norm(), 1e-12);
}

}  // namespace
}  // namespace sprekk::fine_fracture
