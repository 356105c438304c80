// The closed surfaces that bound a mesh in space.
#pragma once

#include <vector>

#include "framework/mesh/face_table.hpp"

namespace sprekk {

/// Outer faces that edges join to one another.
struct OuterShell {
  std::vector<int> faces;
  double volume = 0;  ///< m^3, of what the shell encloses; negative around a hole
};

/// The shells of a mesh whose faces are those of `faces`.
std::vector<OuterShell> outer_shells(const std::vector<Point>& nodes, const FaceTable& faces);

/// How many times cells cover a point that lies on none of these outer faces: their solid angle there over 4 pi.
double cover(const Point& x, const std::vector<int>& outer, const std::vector<Point>& nodes, const FaceTable& faces);

/// Whether a line passes through a face that has no end of it on its plane.
bool pierces(const Point& from, const Point& to, const FaceNodes& face, const std::vector<Point>& nodes);

}  // namespace sprekk
