// Cuts segments at each other, so that segments share nothing but points.
#pragma once

#include <vector>

#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// Segments after cutting: the points, and each segment as a chain of them. Coordinates in m.
struct Arrangement {
  std::vector<Point> points;
  std::vector<std::vector<int>> chains;  ///< per segment: its points, from its beginning to its end
};

/// Cuts the segments, which may touch, cross and overlap. Points nearer to one another than `tolerance` (m) become one
/// point: an end point of the earliest segment, if there is one, or else a crossing.
Arrangement arrange(const std::vector<Segment>& segments, double tolerance);

/// The sides of the box, counter-clockwise from the lower left corner; then the fractures, then the edges of regions.
std::vector<Segment> all_segments(const Geometry& geometry);

}  // namespace sprekk
