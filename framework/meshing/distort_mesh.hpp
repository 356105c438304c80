// Moves nodes at random, for tests on rough meshes.
#pragma once

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Moves each node that lies inside one region and on no fracture by at most `amount` times the shortest edge at it, in
/// a random direction. A move is halved until every triangle at the node keeps a fifth of its area, and every
/// quadrilateral a fifth of the area of the triangle at each of its corners. The same seed gives the same mesh.
void distort_mesh(RawMesh& mesh, double amount, int seed);

}  // namespace sprekk
