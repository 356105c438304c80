// Triangles of a plane region in which some edges are fixed.
#pragma once

#include <array>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// Triangles, with edges and points that must stay.
struct Triangulation {
  /// An edge that must stay an edge.
  struct FixedEdge {
    std::array<int, 2> points;
    bool is_barrier;  ///< an outer boundary or a fracture: no triangle shall have two of them
  };
  std::vector<Point> points;                  ///< m
  std::vector<bool> is_fixed;                 ///< per point: whether it must not move
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise
  std::vector<FixedEdge> fixed_edges;         ///< all edges of the region's boundary, and others inside
};

/// The smallest angle of all triangles, rad.
double smallest_angle(const Triangulation& triangulation);

/// The number of triangles with two barriers: these make the local problems of multi-point schemes singular.
int single_corner_count(const Triangulation& triangulation);

/// Raises the smallest angles. Flips edges that are not fixed, moves points that are not fixed where a move raises the
/// smallest angle around them, and divides triangles with two barriers: by a flip, or by halving the third edge, which
/// adds a point, if this edge is not on the boundary of the region.
void improve(Triangulation& triangulation);

}  // namespace sprekk
