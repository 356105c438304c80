// How far a tip can go straight on before it meets something.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// The first fracture or side that a straight path meets, and the distance to it.
struct FreeLength {
  /// What the path meets.
  enum class Met { nothing, fracture, boundary };
  double length;  ///< m; infinite when nothing is met (from a point outside of the mesh)
  Met met;
  int index;    ///< of the fracture or the side, or none
  Point where;  ///< from + length * direction
};

/// The distance along the ray from `from` to the nearest fracture or the outer boundary. The last segment of `fracture`
/// at the given end does not count. `direction` need not be of unit length; a zero vector throws std::invalid_argument.
FreeLength free_length(const Mesh& mesh, int fracture, bool at_end, const Point& from, const Point& direction);

}  // namespace sprekk
