// A square of two layers, for tests of the discretizations.
#pragma once

#include "tests/components/meshes.hpp"

namespace sprekk::test {

/// A unit square of distorted triangles with the region "lower" below y = 1/2, along whose top faces lie.
inline Mesh two_layers() {
  Geometry geometry = box(1, 1);
  RegionGeometry lower;
  lower.name = "lower";
  lower.polygon = {Point(0, 0), Point(1, 0), Point(1, 0.5), Point(0, 0.5)};
  geometry.regions = {lower};
  return generate_mesh(geometry, unstructured(0.09, 0.3));
}

/// Whether a point is in the lower layer.
inline bool is_lower(const Point& x) { return x[1] < 0.5; }

}  // namespace sprekk::test
