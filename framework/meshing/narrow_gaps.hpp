// Where lines of a geometry lie close to each other.
#pragma once

#include <functional>
#include <vector>

#include "framework/mesh/planar.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// A part of a fracture, of a side of the box or of an edge of a region that has another line beside it.
struct NarrowGap {
  Segment part;
  double width;  ///< m, the least distance between the part and the other line
};

/// Gaps narrower than this part of the edge length asked for are not told apart by default.
inline constexpr double least_gap_part = 0.002;

/// All in m, or m a metre.
struct GapLimits {
  double least;   ///< narrower gaps are not told apart
  double widest;  ///< wider gaps are never narrow
  double slope;   ///< by how much the wanted width varies at most
};

/// Calls `keep` for gaps between a fracture and a side, an edge of a region, another fracture or itself where they are
/// narrower than `wanted` (m, at a place), part by part: along a part the width varies by at most a quarter, or is
/// below `least`. `wanted` may fall by what `keep` does: narrow gaps come first. Lines that touch have an angle between
/// them and no gap, and so have lines to which the way along the fracture is shorter than 1.5 times the gap.
void for_each_narrow_gap(const Geometry& geometry, const GapLimits& limits,
                         const std::function<double(const Point&)>& wanted,
                         const std::function<void(const NarrowGap&)>& keep);

}  // namespace sprekk
