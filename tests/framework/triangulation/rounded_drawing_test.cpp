#include "framework/triangulation/rounded_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace sprekk::test {
namespace {

TEST(RoundedDrawing, RoundNumbersAreNoTies) {
  for (const double spacing : {0x1p-10, 0x1p-7, 1.0}) {
    for (int i = -2000; i <= 2000; ++i) {
      // Multiples of half a spacing, of a millimetre and of an inch.
      for (const double value : {0.5 * i * spacing, 1e-3 * i, 0.0254 * i}) {
        const double low = rounded(value - 1e-12, spacing);
        EXPECT_EQ(low, rounded(value + 1e-12, spacing)) << value << ' ' << spacing;
        EXPECT_LE(std::abs(low - value), 0.62 * spacing);
      }
    }
  }
}

TEST(RoundedDrawing, LengthsKeepTheirSize) {
  for (double length = 1e-4; length < 10; length *= 1.013) {
    const double near = rounded_in_octave(length, 16);
    EXPECT_LT(std::abs(std::log2(near / length)), 0.62 / 16);
    EXPECT_EQ(near, rounded_in_octave(near, 16));
  }
  for (int k = 1; k < 2000; ++k)
    EXPECT_EQ(rounded_in_octave(1e-3 * k * (1 - 1e-12), 16), rounded_in_octave(1e-3 * k * (1 + 1e-12), 16)) << k;
}

TEST(RoundedDrawing, PointsMoveByAPartOfTheLocalLength) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int i = 0; i < 50; ++i) {
    // Two lines with a gap of any width between them, and one far away.
    const double gap = std::pow(10, -3 + 2 * std::abs(place(random)));
    const std::vector<Point> points{
        {-0.4771, 0.0123}, {0.5, 0.1 * place(random)}, {0.1 * place(random), -gap - 0.1}, {0.2, -0.5}, {0.9, 0.9},
        {0.9, 0.7}};
    const std::vector<std::array<int, 2>> lines{{0, 1}, {2, 3}, {4, 5}};
    const std::vector<Point> found = rounded_points(points, lines, 10);
    for (int p = 0; p < 6; ++p) {
      double least = 10;
      for (int q = 0; q < 6; ++q)
        if (q != p) least = std::min(least, (points[p] - points[q]).norm());
      for (const auto& [a, b] : lines)
        if (p != a && p != b) least = std::min(least, distance(points[p], Segment{points[a], points[b]}));
      EXPECT_LE((found[p] - points[p]).norm(), least / 20);
      EXPECT_NE(found[p], points[p]);
    }
  }
}

TEST(RoundedDrawing, AFrameFollowsItsDrawing) {
  const std::vector<Segment> lines{{{1, 1}, {1.3, 1.2}}, {{1.3, 1.2}, {1.6, 1.2}}};
  const DrawingFrame frame = drawing_frame(0.5, lines, {1.1, 1.0});
  EXPECT_EQ(drawing_frame(0.5 * (1 - 1e-12), lines, {1.1, 1.0}).scale, frame.scale);
  std::vector<Segment> image;
  for (const Segment& line : lines) image.push_back({Point(3, 2) - line.to, Point(3, 2) - line.from});
  const DrawingFrame turned = drawing_frame(0.5, image, Point(3, 2) - Point(1.1, 1.0));
  EXPECT_EQ(turned.scale, -frame.scale);
  EXPECT_LT((turned.inward(Point(3, 2) - Point(1.6, 1.2)) - frame.inward({1.6, 1.2})).norm(), 1e-15);
  EXPECT_LT((frame.outward(frame.inward({1.6, 1.2})) - Point(1.6, 1.2)).norm(), 1e-15);
}

}  // namespace
}  // namespace sprekk::test
