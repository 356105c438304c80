// Drawings that are images of one another become the same.
#include "framework/triangulation/canonical_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace sprekk {
namespace {

using Lines = std::vector<std::array<int, 2>>;

/// A quadrilateral with a crack inside; no image of itself.
const std::vector<Point> shape{{0, 0}, {1.3, 0.1}, {1.1, 0.9}, {-0.2, 0.7}, {0.3, 0.3}, {0.6, 0.5}};
const Lines lines{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}};

void expect_same(const CanonicalDrawing& a, const CanonicalDrawing& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.lines, b.lines);
}

TEST(CanonicalDrawing, IsTheSameAfterAShiftHalfATurnAndAnotherOrder) {
  const CanonicalDrawing one(shape, lines);
  std::vector<Point> image;
  for (const Point& x : shape) image.push_back(Point(7.1, -3.3) - x);
  std::reverse(image.begin(), image.end());
  Lines other;
  for (const auto& [a, b] : lines) other.insert(other.begin(), {5 - b, 5 - a});
  const CanonicalDrawing two(image, other);
  expect_same(one, two);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(one.point_number[i], two.point_number[5 - i]);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(one.line_number[i], two.line_number[4 - i]);
}

TEST(CanonicalDrawing, LeadsToItsPlacesAndBack) {
  const CanonicalDrawing drawing(shape, lines);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const Point& x = drawing.points[drawing.point_number[i]];
    EXPECT_LT((drawing.outward(x) - shape[i]).norm(), 1e-9);
    EXPECT_LT((drawing.outward(drawing.inward(shape[i])) - shape[i]).norm(), 1e-15);
    EXPECT_LE(x.cwiseAbs().maxCoeff(), 1);
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::array<int, 2> ends{drawing.point_number[lines[i][0]], drawing.point_number[lines[i][1]]};
    if (drawing.is_reversed[i]) std::swap(ends[0], ends[1]);
    EXPECT_EQ(drawing.lines[drawing.line_number[i]], ends);
    EXPECT_LT(ends[0], ends[1]);
  }
}

TEST(CanonicalDrawing, AnImageOfItselfIsNotTurnedByRounding) {
  const std::vector<Point> square{{0.1, 0.1}, {0.4, 0.1}, {0.4, 0.4}, {0.1, 0.4}};
  const Lines around{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  std::vector<Point> shifted = square;
  for (Point& x : shifted) x += Point(1.0 / 3, 1.0 / 7);
  expect_same({square, around}, {shifted, around});
}

}  // namespace
}  // namespace sprekk
