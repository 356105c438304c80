#include "framework/meshing/space/region_borders.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace sprekk {
namespace {

/// A polygon without what lies on the far side of a plane (Sutherland and Hodgman, Commun. ACM 17 (1974) 32).
std::vector<Point> cut(const std::vector<Point>& polygon, const HalfSpace& half, double tolerance) {
  const Point normal = half.normal.normalized();
  const auto depth = [&](const Point& x) {
    const double found = (x - half.point).dot(normal);
    return std::abs(found) < tolerance ? 0 : found;
  };
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double at_from = depth(from), at_to = depth(to);
    if (at_from >= 0) kept.push_back(from);
    if (at_from * at_to < 0) kept.push_back(from + at_from / (at_from - at_to) * (to - from));
  }
  return kept;
}

std::vector<HalfSpace> half_spaces_of(const Box& box) {
  std::vector<HalfSpace> sides;
  for (int axis = 0; axis < dimension; ++axis) {
    sides.push_back({box.low, Point::Unit(axis)});
    sides.push_back({box.high, -Point::Unit(axis)});
  }
  return sides;
}

/// Whether a polygon lies on a side of the box: that is a border already.
bool is_on_side(const std::vector<Point>& polygon, const Box& box, double tolerance) {
  for (int axis = 0; axis < dimension; ++axis)
    for (const double side : {box.low[axis], box.high[axis]}) {
      bool lies = true;
      for (const Point& corner : polygon) lies = lies && std::abs(corner[axis] - side) < tolerance;
      if (lies) return true;
    }
  return false;
}

}  // namespace

std::vector<std::vector<Point>> region_borders(const Geometry& geometry) {
  const double tolerance = point_tolerance(geometry.box), reach = 2 * geometry.box.size().norm();
  const Point middle = 0.5 * (geometry.box.low + geometry.box.high);
  std::vector<std::vector<Point>> borders;
  for (const RegionGeometry& region : geometry.regions)
    for (std::size_t own = 0; own < region.half_spaces.size(); ++own) {
      // A square in the plane that is larger than the box, cut to the box and to the other planes of the region.
      const HalfSpace& half = region.half_spaces[own];
      const Point normal = half.normal.normalized(), one = normal.unitOrthogonal(), other = normal.cross(one);
      const Point center = middle - (middle - half.point).dot(normal) * normal;
      std::vector<Point> border{center - reach * one - reach * other, center + reach * one - reach * other,
                                center + reach * one + reach * other, center - reach * one + reach * other};
      for (const HalfSpace& side : half_spaces_of(geometry.box)) border = cut(border, side, tolerance);
      for (std::size_t k = 0; k < region.half_spaces.size(); ++k)
        if (k != own) border = cut(border, region.half_spaces[k], tolerance);
      if (border.size() > 2 && !is_on_side(border, geometry.box, tolerance)) borders.push_back(std::move(border));
    }
  return borders;
}

}  // namespace sprekk
