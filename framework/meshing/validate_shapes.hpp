// What validate_geometry asks of fractures and regions, which differ between plane and space.
#pragma once

#include <string>
#include <vector>

#include "framework/meshing/geometry.hpp"

namespace sprekk {

using Problems = std::vector<std::string>;

/// Adds what `validate` throws.
template <class Validate>
void collect(Problems& problems, const Validate& validate) {
  try {
    validate();
  } catch (const InputError& error) {
    problems.push_back(error.what());
  }
}

/// The distance from a point in the box to the nearest side, m; negative outside of the box.
double depth(const Box& box, const Point& x);

/// Throws InputError for a point of `what` that is not finite or lies outside of the box.
void validate_points(const Box& box, const std::vector<Point>& points, const std::string& what, const Origin& origin);

/// Throws InputError for a fracture that cannot be meshed by itself. `snap`: m, as the geometry says, or 0.
void validate_fracture(const Box& box, const FractureGeometry& fracture, double snap);

/// Adds the problems of fractures that lie near one another.
void validate_pairs(const Geometry& geometry, Problems& problems);

/// Throws InputError for a region that cannot be meshed.
void validate_region(const Box& box, const RegionGeometry& region);

/// About as many cells as an unstructured mesh of a valid geometry has.
double wanted_cells(const Geometry& geometry, const MeshOptions& options);

}  // namespace sprekk
