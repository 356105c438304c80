// The convex outline of a fine-level domain.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "framework/mesh/plane/planar.hpp"

namespace sprekk::fine_fracture {

inline Segment outline_edge(const std::vector<Point>& outline, int edge) {
  return {outline[edge], outline[(edge + 1) % outline.size()]};
}

/// The distance of a point inside of a convex counter-clockwise polygon to the nearest edge (m); negative outside.
inline double depth_inside(const Point& x, const std::vector<Point>& outline) {
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Segment edge = outline_edge(outline, static_cast<int>(i));
    depth = std::min(depth, cross(edge.to - edge.from, x - edge.from) / edge.length());
  }
  return depth;
}

inline double outline_extent(const std::vector<Point>& outline) {
  Point low = outline[0], high = outline[0];
  for (const Point& x : outline) low = low.cwiseMin(x), high = high.cwiseMax(x);
  return (high - low).maxCoeff();
}

/// Points nearer than this are one point, m.
inline double outline_tolerance(const std::vector<Point>& outline) {
  constexpr double same_place = 1e-9;  // of the extent: round-off of coordinates
  return same_place * outline_extent(outline);
}

}  // namespace sprekk::fine_fracture
