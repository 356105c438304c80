#include "framework/mesh/quality/cell_angles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprekk {

AngleRange angles(const std::vector<Point>& nodes, const Ring& corners) {
  AngleRange range{std::numeric_limits<double>::infinity(), 0};
  for (int k = 0; k < corners.size(); ++k) {
    const Point u = nodes[corners.after(k)] - nodes[corners[k]], v = nodes[corners.before(k)] - nodes[corners[k]];
    const double angle = std::atan2(std::abs(u.x() * v.y() - u.y() * v.x()), u.dot(v));
    range.smallest = std::min(range.smallest, angle);
    range.largest = std::max(range.largest, angle);
  }
  return range;
}

}  // namespace sprekk
