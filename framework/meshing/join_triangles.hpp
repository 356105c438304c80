// From triangles to a mesh of mostly quadrilaterals.
#pragma once

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Joins pairs of triangles of one region to quadrilaterals, across edges that belong to no fracture. Pairs whose
/// quadrilateral has angles nearest to 90 degrees come first; angles that differ from 90 degrees by more than 50 are
/// not allowed. Other triangles stay, as do those at the ends of fractures, where methods for singular fields need many
/// cells around a node. Nodes do not move. The mesh must have triangles only; the same mesh always gets the same pairs.
void join_triangles(RawMesh& mesh);

}  // namespace sprekk
