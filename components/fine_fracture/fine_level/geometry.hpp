// The geometry of a fine level: a convex polygon of rock with cracks.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// A crack, clipped to the domain: a polyline of straight segments. Its plus side is to the left when walking from the
/// first to the last point; normals of the walls point from plus to minus.
struct CrackPath {
  /// How the walls of a segment are loaded. traction: a traction acts on both walls; jump: the displacements of the
  /// walls differ by a prescribed vector.
  enum class Walls { traction, jump };

  std::vector<Point> points;  ///< m; each end is a tip inside the domain, lies on the outline or at another crack
  bool first_is_tip, last_is_tip;
  std::vector<Walls> walls;  ///< one per segment
};

/// A convex domain with cracks, and the kinds of conditions on its outline.
struct FineGeometry {
  /// What is prescribed on an edge of the outline.
  enum class Side { displacement, traction };

  std::vector<Point> outline;  ///< m, convex, counter-clockwise; edge i joins points i and i + 1
  std::vector<CrackPath> cracks;
  std::vector<Side> sides = {};  ///< one per edge of the outline; empty: displacement everywhere
  /// Paths (m) of fractures outside of the outline, where a fine level takes their jumps; see FineLoads::jump_beyond.
  std::vector<std::vector<Point>> beyond = {};

  Side side(int edge) const { return sides.empty() ? Side::displacement : sides[edge]; }
};

/// One of the tips of a geometry.
struct TipPlace {
  int crack;
  bool is_last;  ///< whether the tip is the last point of the path; else it is the first one
};

/// A place inside of the domain where cracks touch or cross: a point of the paths of all of them.
struct CrackJunction {
  /// A point of a crack.
  struct Vertex {
    int crack, point;
  };
  Point position;                ///< m
  std::vector<Vertex> vertices;  ///< at least two, in ascending order
};

/// All junctions of a geometry, in the order of their first vertices.
std::vector<CrackJunction> junctions(const FineGeometry& geometry);

/// Throws std::invalid_argument when
/// - the outline is not convex and counter-clockwise, or a list has the wrong length;
/// - a crack leaves the domain, or has an end that is neither a tip nor on the outline nor at a junction;
/// - two cracks meet anywhere but in a point of both paths, on the outline, or at a tip.
void validate(const FineGeometry& geometry);

}  // namespace sprekk::fine_fracture
