// Area, centre and angles of triangles and convex quadrilaterals.
#pragma once

#include <vector>

#include "framework/mesh/ring.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// Positive when the corners are counter-clockwise, m^2.
double signed_area(const std::vector<Point>& nodes, const Ring& corners);

/// The centre of gravity of the area, m. Lies inside when the cell is convex.
Point centroid(const std::vector<Point>& nodes, const Ring& corners);

/// The smallest of the signed areas that the corners make with their two neighbours, m^2: of a triangle its own area;
/// positive when a quadrilateral is convex and counter-clockwise.
double smallest_corner_area(const std::vector<Point>& nodes, const Ring& corners);

/// The smallest and largest angle between neighbouring edges, rad, both positive in convex cells of either orientation.
struct AngleRange {
  double smallest, largest;
};
AngleRange angles(const std::vector<Point>& nodes, const Ring& corners);

}  // namespace sprekk
