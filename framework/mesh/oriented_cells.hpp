// Puts the corners of cells into the order of their shapes, as all other code expects.
#pragma once

#include <vector>

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// The corners of all cells in the order of their shapes, not mirrored. Throws InputError for a cell that names a node
/// that does not exist, for one whose number of corners no shape has, and for those that require_sound_cell refuses.
std::vector<CellNodes> oriented_cells(const RawMesh& raw);

/// Throws InputError for a cell without area or volume and for one whose corners are not convex, mirrored or not.
void require_sound_cell(const std::vector<Point>& nodes, const CellNodes& cell);

}  // namespace sprekk
