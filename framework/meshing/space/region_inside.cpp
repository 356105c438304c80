#include <algorithm>

#include "framework/meshing/regions.hpp"

namespace sprekk {

bool is_inside(const Point& x, const RegionGeometry& region) {
  return (!region.bottom || x.z() >= region.bottom(x.x(), x.y())) &&
         (!region.top || x.z() < region.top(x.x(), x.y())) &&
         std::ranges::all_of(region.half_spaces,
                             [&](const HalfSpace& half) { return (x - half.point).dot(half.normal) >= 0; });
}

}  // namespace sprekk
