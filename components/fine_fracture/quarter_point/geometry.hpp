// The piece of rock that the fine level looks at: a convex polygon with cracks.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// A crack, clipped to the domain: a polyline of straight segments. Its plus side is to the left when walking from the
/// first to the last point; normals of the walls point from plus to minus.
struct CrackPath {
  /// How the walls of a segment are loaded. traction: both are free and feel a prescribed traction; jump: their
  /// displacements differ by a prescribed vector.
  enum class Walls { traction, jump };

  std::vector<Point> points;  ///< m; each end is a tip inside the domain or lies on the outline
  bool first_is_tip, last_is_tip;
  std::vector<Walls> walls;  ///< one per segment
};

struct FineGeometry {
  /// What is prescribed on an edge of the outline.
  enum class Side { displacement, traction };

  std::vector<Point> outline;  ///< m, convex, counter-clockwise; edge i joins points i and i + 1
  std::vector<CrackPath> cracks;
  std::vector<Side> sides = {};  ///< one per edge of the outline; empty: displacement everywhere

  Side side(int edge) const { return sides.empty() ? Side::displacement : sides[edge]; }
};

/// Throws std::invalid_argument when the outline is not convex and counter-clockwise, when a list has the wrong length,
/// or when a crack leaves the domain, has an end that is neither tip nor on the outline, or meets another crack.
void validate(const FineGeometry& geometry);

}  // namespace sprekk::fine_fracture
