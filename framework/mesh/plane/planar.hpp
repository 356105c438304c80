// Plane geometry on points and segments.
#pragma once

#include <array>
#include <vector>

#include "framework/mesh/geometry.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// A straight segment; coordinates in m.
struct Segment {
  Point from, to;
  double length() const { return (to - from).norm(); }
};

inline double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }  ///< a × b, out of plane

/// Positive when a, b, c turn counter-clockwise.
inline double signed_area(const Point& a, const Point& b, const Point& c) { return 0.5 * cross(b - a, c - a); }

/// Positive when the polygon is counter-clockwise.
double signed_area(const std::vector<Point>& polygon);

double distance(const Point& point, const Segment& segment);  ///< m, to the nearest point of the segment

/// The smallest distance between two segments; 0 when they cross.
double distance(const Segment& a, const Segment& b);

/// Whether the segments cross in the inside of both, and then where.
bool cross_inside(const Segment& a, const Segment& b, Point& crossing);

/// Whether a point lies inside of a simple polygon (even-odd rule; points on its edges may go either way).
bool is_inside(const Point& point, const std::vector<Point>& polygon);

/// The smallest angle of a triangle, in rad; 0 or less when it is degenerate or clockwise.
double smallest_angle(const Point& a, const Point& b, const Point& c);

}  // namespace sprekk
