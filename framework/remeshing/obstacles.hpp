// What the path of a fracture may come near to: cells of fractures, and faces on the outer boundary.
#pragma once

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk {

/// A fracture cell, from its first point to its last one.
Segment cell_segment(const Mesh& mesh, int fracture_cell);

/// A face, from its first node to its second one.
Segment face_segment(const Mesh& mesh, int face);

/// The straight part of the side that a face belongs to. Checks of a path use this part where results must not depend
/// on the lengths of edges.
Segment straight_side(const Mesh& mesh, int face);

/// The straight part of the fracture that a cell belongs to.
Segment straight_part(const Mesh& mesh, int fracture_cell);

}  // namespace sprekk
