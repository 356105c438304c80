// The planes that bound regions in space.
#pragma once

#include <vector>

#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// The flat polygons inside of the box on which regions begin and end.
std::vector<std::vector<Point>> region_borders(const Geometry& geometry);

}  // namespace sprekk
