// Area and centre of triangles and convex quadrilaterals.
#pragma once

#include <vector>

#include "framework/mesh/ring.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// The signed area of a cell, m^2; positive when the corners are counter-clockwise.
double signed_area(const std::vector<Point>& nodes, const Ring& corners);

/// The centre of gravity of the area, m; it lies inside when the cell is convex.
Point centroid(const std::vector<Point>& nodes, const Ring& corners);

/// The smallest signed area of the triangles of each corner with its two neighbours, m^2. For a triangle this is its
/// own area; for a quadrilateral it is positive when the quadrilateral is convex and counter-clockwise.
double smallest_corner_area(const std::vector<Point>& nodes, const Ring& corners);

}  // namespace sprekk
