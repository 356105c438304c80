// The common area of the triangles of two triangulations.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// Corners of triangles, counter-clockwise, in m.
using Corners = std::array<Point, 3>;

/// The area of the intersection of two triangles, m^2; exact up to rounding relative to the smaller of them, wherever
/// they lie.
double common_area(const Corners& a, const Corners& b);

/// Calls visit(i, j, area) for each pair of a triangle of `one` and one of `other` with common area, i ascending, then
/// j ascending. Looks pairs up in buckets: the work is about proportional to the number of pairs.
void for_each_overlap(const std::vector<Corners>& one, const std::vector<Corners>& other,
                      const std::function<void(int, int, double)>& visit);

}  // namespace sprekk
