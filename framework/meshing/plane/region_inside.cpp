#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/regions.hpp"

namespace sprekk {

bool is_inside(const Point& x, const RegionGeometry& region) { return is_inside(x, region.polygon); }

}  // namespace sprekk
