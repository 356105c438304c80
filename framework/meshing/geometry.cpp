#include "framework/meshing/geometry.hpp"

#include <algorithm>

#include "framework/round_off.hpp"

namespace sprekk {

double far_size(const Geometry& geometry, const MeshOptions& options) {
  constexpr double cells_across =
      dimension == 2 ? 50 : 20;  // of the longer side: where a scene says nothing about sizes
  return options.size.value_or(geometry.box.size().maxCoeff() / cells_across);
}

double size_at(const FractureGeometry& fracture, const Geometry& geometry, const MeshOptions& options) {
  return fracture.size.value_or(options.fracture_size.value_or(far_size(geometry, options)));
}

double shortest_size(const Geometry& geometry, const MeshOptions& options) {
  double shortest = far_size(geometry, options);
  if (options.kind == MeshOptions::Kind::structured) {
    for (int axis = 0; axis < dimension; ++axis)
      if (options.cells[axis] > 0) shortest = std::min(shortest, geometry.box.size()[axis] / options.cells[axis]);
    return shortest;
  }
  for (const FractureGeometry& fracture : geometry.fractures)
    shortest = std::min({shortest, size_at(fracture, geometry, options), options.tip_size.value_or(shortest)});
  for (const SidePart& part : geometry.side_parts) shortest = std::min(shortest, part.size.value_or(shortest));
  return shortest;
}

double snap_length(const Geometry& geometry, const MeshOptions& options) {
  constexpr double part_of_cell = 0.01;  // as paths of growing fractures are moved onto sides and others
  return geometry.snap.value_or(part_of_cell * shortest_size(geometry, options));
}

double extent_of(const FractureGeometry& fracture) {
  if (fracture.ellipse) return 2 * std::max(fracture.ellipse->one_axis.norm(), fracture.ellipse->other_axis.norm());
  double extent = 0;
  for (const Point& one : fracture.points)
    for (const Point& other : fracture.points) extent = std::max(extent, (one - other).norm());
  return extent;
}

double point_tolerance(const Box& box) { return rounding::same * box.size().norm(); }

}  // namespace sprekk
