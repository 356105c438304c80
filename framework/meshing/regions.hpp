// Which region of a geometry a point lies in.
#pragma once

#include <vector>

#include "framework/mesh/raw_mesh.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// `rock`, then the polygons' names.
std::vector<std::string> region_names(const Geometry& geometry);

/// Gives every cell the last polygon that holds its centre, or region 0.
void assign_regions(const Geometry& geometry, RawMesh& mesh);

}  // namespace sprekk
