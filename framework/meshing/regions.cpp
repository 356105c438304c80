#include "framework/meshing/regions.hpp"

#include "framework/mesh/geometry.hpp"
#include "framework/mesh/medium.hpp"

namespace sprekk {

std::vector<std::string> region_names(const Geometry& geometry) {
  std::vector<std::string> names{medium_name()};
  for (const RegionGeometry& region : geometry.regions) names.push_back(region.name);
  return names;
}

void assign_regions(const Geometry& geometry, RawMesh& mesh) {
  mesh.region_names = region_names(geometry);
  mesh.regions.assign(mesh.cells.size(), 0);
  if (geometry.regions.empty()) return;
  for (std::size_t t = 0; t < mesh.cells.size(); ++t) {
    const Point center = cell_geometry(mesh.nodes, mesh.cells[t]).center;
    for (std::size_t i = 0; i < geometry.regions.size(); ++i) {
      if (is_inside(center, geometry.regions[i])) mesh.regions[t] = static_cast<int>(i) + 1;
    }
  }
}

}  // namespace sprekk
