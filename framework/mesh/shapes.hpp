// The shapes that cells and faces may have.
#pragma once

#include <array>
#include <span>
#include <type_traits>

#include "framework/mesh/ring.hpp"
#include "framework/mesh/short_list.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// The nodes of a cell, in the order of its shape.
using CellNodes = std::conditional_t<dimension == 2, Ring, ShortList<8>>;
/// The faces of a cell, in the order of its shape.
using CellFaces = std::conditional_t<dimension == 2, Ring, ShortList<6>>;
/// The nodes of a face: two in a plane; three or four in space, in their order around it.
using FaceNodes = std::conditional_t<dimension == 2, std::array<int, 2>, ShortList<4>>;
/// What a face ends at: a node in a plane, an edge in space.
using RidgeNodes = std::array<int, dimension - 1>;
/// The ridges of a face, or of a fracture cell: as many as it has nodes.
using FaceRidges = FaceNodes;

/// A shape of cells. Corners are numbered as gmsh does: counter-clockwise in a plane; in space the bottom of a wedge or
/// a hexahedron, or three corners of a tetrahedron, counter-clockwise as seen from the others, which follow.
struct Shape {
  const char* name;
  int corners;
  /// The corners of each face. In a plane face k joins corner k and the one after it; in space the corners of a face
  /// turn counter-clockwise as seen from outside of the cell.
  std::span<const FaceNodes> faces;
};

/// The shape with so many corners: triangle, quadrilateral; tetrahedron, wedge, hexahedron. nullptr for other numbers.
const Shape* shape_with(int corners);

/// As many faces as a cell with these nodes has, to be numbered.
CellFaces faces_to_number(const CellNodes& cell);

/// The nodes of face k of a cell that has a shape, in the order of that shape.
FaceNodes nodes_of_face(const CellNodes& cell, int k);

/// Ridge k of a face: its node k in a plane; in space the edge from its node k to the one after it.
RidgeNodes ridge_of(const FaceNodes& face, int k);

/// The face as seen from its other side.
FaceNodes reversed(const FaceNodes& face);

/// Whether two faces have the same nodes.
bool have_same_nodes(const FaceNodes& one, const FaceNodes& other);

/// Whether two faces with the same nodes are seen from the same side.
bool turn_alike(const FaceNodes& one, const FaceNodes& other);

}  // namespace sprekk
