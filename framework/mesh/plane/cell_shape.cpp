#include "framework/mesh/plane/cell_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/mesh/plane/planar.hpp"

namespace sprekk {

double signed_area(const std::vector<Point>& nodes, const Ring& corners) {
  const Point &p = nodes[corners[0]], &q = nodes[corners[1]], &r = nodes[corners[2]];
  if (corners.size() == 3) return signed_area(p, q, r);
  return 0.5 * cross(r - p, nodes[corners[3]] - q);
}

Point centroid(const std::vector<Point>& nodes, const Ring& corners) {
  const Point &p = nodes[corners[0]], &q = nodes[corners[1]], &r = nodes[corners[2]];
  if (corners.size() == 3) return (p + q + r) / 3;
  // Relative to a corner, so that coordinates far from the origin cost no digits.
  const Point to_q = q - p, to_r = r - p, to_s = nodes[corners[3]] - p;
  const double one = cross(to_q, to_r), other = cross(to_r, to_s);
  return p + (one * (to_q + to_r) + other * (to_r + to_s)) / (3 * (one + other));
}

double smallest_corner_area(const std::vector<Point>& nodes, const Ring& corners) {
  if (corners.size() == 3) return signed_area(nodes, corners);
  double smallest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < corners.size(); ++k) {
    smallest = std::min(smallest, signed_area(nodes[corners.before(k)], nodes[corners[k]], nodes[corners.after(k)]));
  }
  return smallest;
}

}  // namespace sprekk
