// Better shapes for triangles whose sizes are right.
#pragma once

#include <vector>

#include "framework/mesh/ring.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// In each round, flips edges that have a free end where the worse of the two triangles' shapes gets better, then moves
/// every free point towards the mean of its neighbours if the worst shape around it gets no worse (Laplacian smoothing,
/// guarded). Shape is area over the sum of squared edge lengths. No shape around becomes worse than the worst before,
/// so that a valid mesh stays valid. Triangles are counter-clockwise, and edges between two points that are not free
/// stay. The order of points and triangles decides; it costs about 0.5 microseconds a triangle and round.
void smooth_triangles(std::vector<Point>& points, std::vector<Ring>& triangles, const std::vector<char>& is_free,
                      int rounds);

}  // namespace sprekk
