// Polygons in space, in the coordinates of their plane.
#pragma once

#include <vector>

#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// A place in a plane, m.
using FlatPoint = Eigen::Vector2d;

/// A flat polygon in space. An ellipse is treated as a polygon with many corners.
class FlatShape {
 public:
  /// The plane of the corners: through their mean, with the area vector of the polygon. Three corners at least.
  explicit FlatShape(const std::vector<Point>& corners);
  explicit FlatShape(const FractureGeometry& fracture);

  const std::vector<Point>& corners() const { return corners_; }      ///< as given
  const std::vector<FlatPoint>& outline() const { return outline_; }  ///< counter-clockwise as seen against the normal
  const Point& normal() const { return axes_[2]; }                    ///< unit; the corners turn about it
  double area() const { return area_; }                               ///< m^2; 0 where it has no plane
  double height(const Point& x) const { return (x - origin_).dot(normal()); }  ///< m, above the plane
  FlatPoint in_plane(const Point& x) const { return {(x - origin_).dot(axes_[0]), (x - origin_).dot(axes_[1])}; }
  Point in_space(const FlatPoint& x) const { return origin_ + x.x() * axes_[0] + x.y() * axes_[1]; }

  /// The largest distance of a corner from the plane, m.
  double farthest_from_plane() const;
  /// Whether it contains a place of its plane; those nearer than `margin` (m) to its outline do for a negative margin
  /// and do not for a positive one.
  bool contains(const FlatPoint& x, double margin) const;
  double distance(const Point& x) const;  ///< m, to the nearest point of the polygon
  Point low() const;                      ///< of its bounding box
  Point high() const;

 private:
  std::vector<Point> corners_;
  std::vector<FlatPoint> outline_;
  Point origin_ = Point::Zero();
  std::array<Point, 3> axes_;  ///< two in the plane, and the normal
  double area_ = 0;
};

/// A straight line between two places in space, m.
struct Line {
  Point from, to;
};

/// The edges of a polygon.
std::vector<Line> edges_of(const std::vector<Point>& corners);

/// The point of the line that is nearest to x.
Point nearest_point(const Point& x, const Line& line);

/// The points of two lines that are nearest to one another.
std::pair<Point, Point> nearest_points(const Line& one, const Line& other);

}  // namespace sprekk
