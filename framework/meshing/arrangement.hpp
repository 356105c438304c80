// Segments cut at each other, so that they meet in common points only.
#pragma once

#include <vector>

#include "framework/mesh/planar.hpp"

namespace sprekk {

struct Arrangement {
  std::vector<Point> points;
  std::vector<std::vector<int>> chains;  ///< per segment: its points, from its beginning to its end
};

/// Points nearer than `tolerance` become one: the end points of earlier segments win over those of later ones, and
/// these over crossings. Segments may touch, cross and overlap.
Arrangement arrange(const std::vector<Segment>& segments, double tolerance);

}  // namespace sprekk
