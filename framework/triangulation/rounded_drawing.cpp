#include "framework/triangulation/rounded_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

constexpr int finer = 5;                       ///< powers of two between the local length and the spacing
constexpr double no_round_number = 1.2345678;  ///< factor on lengths: powers of two are then not at an octave's edge

/// The least distances between points, or lines that end there, and what they do not touch.
std::vector<double> local_lengths(const std::vector<Point>& points, const std::vector<std::array<int, 2>>& lines,
                                  double largest) {
  std::vector<double> least(points.size(), largest);
  const auto note = [&](int point, double length) { least[point] = std::min(least[point], length); };
  for (const auto& [a, b] : lines) {
    const Segment line{points[a], points[b]};
    note(a, line.length());
    note(b, line.length());
    for (int p = 0; p < static_cast<int>(points.size()); ++p) {
      if (p == a || p == b) continue;
      const double away = distance(points[p], line);
      for (const int point : {p, a, b}) note(point, away);
    }
  }
  return least;
}

}  // namespace

/// With the golden ratio, values that are simple parts of the spacing lie on no border.
double rounded(double value, double spacing) { return std::floor(value / spacing + std::numbers::phi - 1) * spacing; }

double rounded_in_octave(double value, int steps) {
  SPREKK_EXPECT(value > 0 && steps > 0, value, steps);
  return std::exp2(rounded(std::log2(value) * steps, 1) / steps);
}

DrawingFrame drawing_frame(double extent, const std::vector<Segment>& lines, const Point& anchor) {
  DrawingFrame frame{anchor, std::exp2(std::floor(std::log2(no_round_number * extent)))};
  Point mean = Point::Zero();
  double length = 0;
  for (const Segment& line : lines) {
    mean += line.length() * frame.inward(0.5 * (line.from + line.to));
    length += line.length();
  }
  if (length > 0) mean /= length;
  if (mean.x() < -rounding::far_above || (mean.x() < rounding::far_above && mean.y() < -rounding::far_above))
    frame.scale = -frame.scale;
  return frame;
}

std::vector<Point> rounded_points(const std::vector<Point>& points, const std::vector<std::array<int, 2>>& lines,
                                  double largest) {
  const std::vector<double> lengths = local_lengths(points, lines, largest);
  std::vector<Point> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.push_back(points[i]);
    if (!(lengths[i] > 0)) continue;  // lines that cross: a mesh generator will say so
    const double spacing = std::exp2(std::floor(std::log2(no_round_number * lengths[i])) - finer);
    for (double& coordinate : result.back()) coordinate = rounded(coordinate, spacing);
  }
  return result;
}

}  // namespace sprekk
