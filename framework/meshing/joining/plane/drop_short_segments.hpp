// Thins out the points of lines that were digitized densely.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// The numbers of the points that stay when a line takes no steps shorter than `shortest` (m): runs of shorter steps
/// are replaced by the fewest points from which no other one of the run is farther (Douglas and Peucker, The Canadian
/// Cartographer 10 (1973) 112). The ends stay, and all points outside of such runs. `is_closed`: the last point is
/// joined with the first.
std::vector<int> without_short_segments(const std::vector<Point>& points, double shortest, bool is_closed);

}  // namespace sprekk
