#include "components/fine_fracture/boundary_element/places_of_offset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/fine_fracture/fine_level/outline.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk::fine_fracture {

std::vector<Point> places_of_offset(const FineGeometry& geometry, double spacing) {
  std::vector<Point> places;
  std::vector<Segment> segments;
  constexpr double apart = 0.6;  // of the spacing
  const auto add = [&](const Point& x) {
    for (const Point& other : places)
      if ((x - other).norm() < apart * spacing) return;
    places.push_back(x);
  };
  for (const CrackPath& crack : geometry.cracks)
    for (std::size_t i = 0; i + 1 < crack.points.size(); ++i) {
      segments.push_back({crack.points[i], crack.points[i + 1]});
      const Point way = crack.points[i + 1] - crack.points[i];
      const int count = std::max(1, static_cast<int>(std::ceil(way.norm() / spacing)));
      for (int k = 0; k <= count; ++k) add(crack.points[i] + double(k) / count * way);
    }
  Point low = geometry.outline[0], high = low;
  for (const Point& x : geometry.outline) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double tolerance = outline_tolerance(geometry.outline);
  const auto grid = [&](const auto& self, const Point& from, const Point& to, int level) -> void {
    constexpr int least = 3, most = 10;  // 8 edges across at least
    constexpr double growth = 0.5;       // of edges, per distance from a crack
    const Point middle = 0.5 * (from + to);
    double away = std::numeric_limits<double>::infinity();
    for (const Segment& segment : segments) away = std::min(away, sprekk::distance(middle, segment));
    if (level < least || (level < most && (to - from).maxCoeff() > std::max(spacing, growth * away))) {
      for (const double x : {0.0, 0.5})
        for (const double y : {0.0, 0.5}) {
          const Point corner = from + (to - from).cwiseProduct(Point(x, y));
          self(self, corner, corner + 0.5 * (to - from), level + 1);
        }
      return;
    }
    for (const Point& x : {from, Point(to[0], from[1]), to, Point(from[0], to[1])})
      if (depth_inside(x, geometry.outline) > -tolerance) add(x.cwiseMax(low).cwiseMin(high));
  };
  grid(grid, low, high, 0);
  return places;
}

}  // namespace sprekk::fine_fracture
