// Joins the triangles of a mesh to quadrilaterals where these have good angles.
#pragma once

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Joins pairs of triangles of one region to quadrilaterals, across edges that belong to no fracture. Pairs whose
/// quadrilateral has angles nearest to 90 degrees come first; angles that differ from 90 degrees by more than 50 are
/// not allowed. All other triangles stay. So do triangles at the ends of fractures, since methods for singular fields
/// need many cells around a node. Nodes do not move. The mesh must have triangles only; the same mesh always gets the
/// same pairs.
void join_triangles(RawMesh& mesh);

}  // namespace sprekk
