// Finds where lines of a geometry lie close to each other.
#pragma once

#include <functional>
#include <vector>

#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// A part of a fracture, of a side of the box or of an edge of a region, with another line close beside it.
struct NarrowGap {
  Segment part;
  double width;  ///< m, the least distance between the part and the other line
};

/// The default of GapLimits::least, over the edge length that is asked for.
inline constexpr double least_gap_part = 0.002;

/// Limits of the search for narrow gaps.
struct GapLimits {
  double least;   ///< m; gaps narrower than this are treated as equally wide
  double widest;  ///< m; gaps wider than this are never narrow
  double slope;   ///< m per m; the largest slope of the wanted width
};

/// Calls `keep` for gaps that are narrower than `wanted` (m, at a place), between a fracture and a side, an edge of a
/// region, another fracture or the fracture itself. Gaps are given part by part: along a part the width varies by at
/// most a quarter, or is below `least`. `keep` may reduce what `wanted` returns; the narrowest gaps come first. Lines
/// that touch form an angle, not a gap. Two places of one fracture form a gap only if their distance along the fracture
/// is at least 1.5 times the gap.
void for_each_narrow_gap(const Geometry& geometry, const GapLimits& limits,
                         const std::function<double(const Point&)>& wanted,
                         const std::function<void(const NarrowGap&)>& keep);

}  // namespace sprekk
