// Which region of a geometry a point lies in.
#pragma once

#include <vector>

#include "framework/mesh/raw_mesh.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// `rock`, then the polygons' names.
std::vector<std::string> region_names(const Geometry& geometry);

/// Sets the region of every cell: that of the last polygon that contains the centre of the cell, or else region 0.
void assign_regions(const Geometry& geometry, RawMesh& mesh);

}  // namespace sprekk
