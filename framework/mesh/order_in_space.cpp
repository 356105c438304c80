#include "framework/mesh/order_in_space.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "framework/invariants.hpp"

namespace sprekk {

namespace {

/// The place of square (x, y) along Hilbert's curve through 2^bits × 2^bits squares.
std::uint64_t place_on_curve(std::uint32_t x, std::uint32_t y, int bits) {
  std::uint64_t place = 0;
  for (int bit = bits - 1; bit >= 0; --bit) {
    const std::uint32_t right = x >> bit & 1, upper = y >> bit & 1;
    place = place << 2 | ((3 * right) ^ upper);
    if (upper) continue;
    if (right) {
      x = ~x;
      y = ~y;
    }
    std::swap(x, y);
  }
  return place;
}

}  // namespace

std::vector<int> order_in_space(const std::vector<Point>& points) {
  if (points.empty()) return {};
  constexpr int bits = 16;  // 65,536 places along each axis
  Point low = points[0], high = points[0];
  for (const Point& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double size = (high - low).maxCoeff();
  SPREKK_EXPECT(std::isfinite(size), size);
  const double scale = size > 0 ? ((1 << bits) - 1) / size : 0;
  std::vector<std::pair<std::uint64_t, int>> places;
  places.reserve(points.size());
  for (const Point& point : points) {
    const Point at = scale * (point - low);
    places.emplace_back(place_on_curve(static_cast<std::uint32_t>(at[0]), static_cast<std::uint32_t>(at[1]), bits),
                        static_cast<int>(places.size()));
  }
  std::sort(places.begin(), places.end());
  std::vector<int> order;
  order.reserve(points.size());
  for (const auto& [place, point] : places) order.push_back(point);
  SPREKK_ASSERT(order.size() == points.size(), order.size(), points.size());
  return order;
}

}  // namespace sprekk
