// Improves the shapes of triangles whose sizes are right.
#pragma once

#include <vector>

#include "framework/mesh/ring.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// In each round, flips every edge with a free end if this improves the worse of the shapes of its two triangles. Then
/// moves every free point towards the mean of its neighbours if the worst shape around it gets no worse (guarded
/// Laplacian smoothing). Shape is area over the sum of squared edge lengths. No shape becomes worse than the worst one
/// around it before, so a valid mesh stays valid. Triangles are counter-clockwise, and edges between two points that
/// are not free stay. The result depends on the order of points and triangles; a round costs about 0.5 microseconds a
/// triangle.
void smooth_triangles(std::vector<Point>& points, std::vector<Ring>& triangles, const std::vector<char>& is_free,
                      int rounds);

}  // namespace sprekk
