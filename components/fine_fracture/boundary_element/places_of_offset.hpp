// Where a boundary-element model takes the stress offset and the body force.
#pragma once

#include <vector>

#include "components/fine_fracture/fine_level/geometry.hpp"

namespace sprekk::fine_fracture {

/// Places (m) along the cracks, where pore pressure has its peaks, and on a grid in the outline that becomes coarser
/// with the distance from the cracks. `spacing`: the distance between neighbouring places at the cracks, m.
std::vector<Point> places_of_offset(const FineGeometry& geometry, double spacing);

}  // namespace sprekk::fine_fracture
