// Orients the cells of a given mesh counter-clockwise, as all other code expects.
#pragma once

#include <vector>

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// The rings of nodes of all cells, counter-clockwise. Throws InputError for a cell that names a node that does not
/// exist, for a triangle without area, and for a quadrilateral that is not convex.
std::vector<Ring> counter_clockwise(const RawMesh& raw);

/// Throws InputError for a triangle without area and for a quadrilateral that is not convex.
void require_area(const std::vector<Point>& nodes, const Ring& cell);

}  // namespace sprekk
