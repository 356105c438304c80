// The sides of a box in space.
#pragma once

#include "framework/mesh/raw_mesh.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// Gives each outer face of a mesh that fills the box the side that it lies on, and moves its nodes onto it, without
/// round-off. Throws InputError for cells that overlap.
void take_outer_sides(const Box& box, RawMesh& mesh);

}  // namespace sprekk
