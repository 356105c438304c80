// From triangles to a mesh of mostly quadrilaterals.
#pragma once

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Joins pairs of triangles of one region across edges that belong to no fracture, the best pairs first: those whose
/// quadrilateral has angles nearest to 90 degrees, at most 50 degrees away from them. Other triangles stay, as do
/// those at the ends of fractures, where methods for singular fields want many cells around a node. Nodes stay where
/// they are. Takes triangles only; the same mesh always gets the same pairs.
void join_triangles(RawMesh& mesh);

}  // namespace sprekk
