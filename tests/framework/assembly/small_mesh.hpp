// A mesh of a few cells, for tests of equations that only need numbers of cells.
#pragma once

#include "framework/mesh/partition.hpp"
#include "framework/meshing/generate_mesh.hpp"

namespace sprekk::test {

/// The unit square in triangles with edges of about `size`, in one process.
inline Mesh small_mesh(double size) {
  Geometry geometry;
  geometry.box.low = Point(0, 0);
  geometry.box.high = Point(1, 1);
  MeshOptions options;
  options.size = size;
  Mesh mesh = generate_mesh(geometry, options);
  partition(mesh, 1);
  return mesh;
}

}  // namespace sprekk::test
