// Linear functions on faces, by their values at the centre and how much they change along the face.
#pragma once

#include <array>
#include <functional>

#include "framework/discretization/subface.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// One number for each direction along a face:
/// - in a plane from its first to its second node;
/// - in space on a triangle from its first node to the second, and to the third;
/// - on a quadrilateral between the middles of opposite edges: from that of edge (4, 1), and from that of edge (1, 2).
inline constexpr int directions_of_faces = dimension - 1;
using AlongFace = std::array<double, directions_of_faces>;

/// The directions, m.
std::array<Point, directions_of_faces> directions_of_face(const Mesh& mesh, int face);

/// Where a continuity point near a node lies along the face, in its directions from its centre: a linear function has
/// the value at the centre + the sum of position · change there.
AlongFace position_along_face(const Mesh& mesh, int face, int node, const ContinuityPoint& point);

/// A linear function on a face.
struct LinearOnFace {
  double at_center;
  AlongFace changes;
};

/// The linear function that fits `value` best at the points a third of the way from the centre of a face to its nodes.
LinearOnFace linear_on_face(const Mesh& mesh, int face, const std::function<double(const Point&)>& value);

/// The most by which a linear function with these changes exceeds its value at the centre of the face.
double highest_along_face(const Mesh& mesh, int face, const AlongFace& changes);

}  // namespace sprekk
