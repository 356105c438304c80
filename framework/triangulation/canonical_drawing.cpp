#include "framework/triangulation/canonical_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/round_off.hpp"
#include "framework/triangulation/delaunay.hpp"

namespace sprekk {
namespace {

/// Rounds to the grid; the sum replaces a negative zero by zero.
Point rounded(const Point& x) {
  constexpr auto grid = Delaunay::grid;
  return {std::round(x.x() / grid) * grid + 0.0, std::round(x.y() / grid) * grid + 0.0};
}

/// The position of each of `count` items in sorted order.
template <class IsLess>
std::vector<int> ranks(std::size_t count, const IsLess& is_less) {
  std::vector<int> order(count), rank(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), is_less);
  for (std::size_t i = 0; i < count; ++i) rank[order[i]] = static_cast<int>(i);
  return rank;
}

}  // namespace

CanonicalDrawing::CanonicalDrawing(const std::vector<Point>& given, const std::vector<std::array<int, 2>>& joined) {
  Point low = given.front(), high = low, mean = Point::Zero();
  for (const Point& x : given) low = low.cwiseMin(x), high = high.cwiseMax(x);
  origin_ = 0.5 * (low + high);
  scale_ = std::exp2(std::floor(std::log2((high - low).maxCoeff())));
  for (const auto& [from, to] : joined) mean += inward(0.5 * (given[from] + given[to]));
  if (mean.x() < -rounding::far_above || (mean.x() < rounding::far_above && mean.y() < -rounding::far_above))
    scale_ = -scale_;

  points.resize(given.size());
  std::transform(given.begin(), given.end(), points.begin(), [this](const Point& x) { return rounded(inward(x)); });
  point_number = ranks(points.size(), [this](int a, int b) {
    return std::pair(points[a].x(), points[a].y()) < std::pair(points[b].x(), points[b].y());
  });
  const std::vector<Point> unsorted = points;
  for (std::size_t i = 0; i < unsorted.size(); ++i) points[point_number[i]] = unsorted[i];

  std::vector<std::array<int, 2>> directed;
  for (const auto& [from, to] : joined) {
    const int a = point_number[from], b = point_number[to];
    directed.push_back({std::min(a, b), std::max(a, b)});
    is_reversed.push_back(a > b);
  }
  line_number = ranks(directed.size(), [&](int a, int b) { return directed[a] < directed[b]; });
  lines.resize(directed.size());
  for (std::size_t i = 0; i < directed.size(); ++i) lines[line_number[i]] = directed[i];
}

}  // namespace sprekk
