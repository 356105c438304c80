// The sides of a box in space.
#pragma once

#include "framework/mesh/raw_mesh.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// Gives each outer face of a mesh that fills the box the side that it lies on, or the part of it, and moves its nodes
/// onto it, without round-off. Throws InputError for cells that overlap, and for a part that faces do not follow.
void take_outer_sides(const Geometry& geometry, RawMesh& mesh);

/// The corners of a part of a side, in their order, m.
std::vector<Point> corners_of(const SidePart& part, const Box& box);

}  // namespace sprekk
