#include "framework/mesh/plane/planar.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk {

double signed_area(const std::vector<Point>& polygon) {
  SPREKK_EXPECT(polygon.size() >= 3, polygon.size());
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    // Relative to the first corner, so that a polygon far from the origin loses no digits.
    twice += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  }
  return 0.5 * twice;
}

double distance(const Point& point, const Segment& segment) {
  const Point along = segment.to - segment.from;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp((point - segment.from).dot(along) / square, 0.0, 1.0) : 0.0;
  return (segment.from + t * along - point).norm();
}

double distance(const Segment& a, const Segment& b) {
  Point crossing;
  if (cross_inside(a, b, crossing)) return 0;
  return std::min({distance(a.from, b), distance(a.to, b), distance(b.from, a), distance(b.to, a)});
}

bool cross_inside(const Segment& a, const Segment& b, Point& crossing) {
  const Point u = a.to - a.from, v = b.to - b.from, w = b.from - a.from;
  const double determinant = cross(u, v);
  if (determinant == 0) return false;
  const double s = cross(w, v) / determinant, t = cross(w, u) / determinant;
  if (!(s > 0 && s < 1 && t > 0 && t < 1)) return false;
  crossing = a.from + s * u;
  return true;
}

bool is_inside(const Point& point, const std::vector<Point>& polygon) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point &a = polygon[i], &b = polygon[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

double smallest_angle(const Point& a, const Point& b, const Point& c) {
  const double twice_area = cross(b - a, c - a);
  const auto dots = {(b - a).dot(c - a), (c - b).dot(a - b), (a - c).dot(b - c)};
  // All have this area: the smallest belongs to the largest dot product, or to the smallest one if the triangle is
  // turned.
  return std::atan2(twice_area, twice_area < 0 ? std::min(dots) : std::max(dots));
}

}  // namespace sprekk
