// Which region of a geometry a point lies in.
#pragma once

#include <vector>

#include "framework/mesh/raw_mesh.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// The names of all regions: medium_name(), then those that the geometry names.
std::vector<std::string> region_names(const Geometry& geometry);

/// Whether a point (m) lies in a region.
bool is_inside(const Point& x, const RegionGeometry& region);

/// Assigns each cell to the last region that contains the centre of the cell, or to region 0 where there is none.
void assign_regions(const Geometry& geometry, RawMesh& mesh);

}  // namespace sprekk
