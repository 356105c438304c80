// A mesh in which a fracture grows between others.
#pragma once

#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {

/// "main" grows; "wall" stands across its way, and "edge" reaches the right side. `size`: of edges, m.
inline Mesh mesh_with_obstacles(double size) {
  Geometry geometry = box(0, 4, 0, 2);
  geometry.fractures = {fracture("main", {{0.5, 0.5}, {1, 1}, {1.5, 1}}), fracture("wall", {{2.5, 0.5}, {2.5, 1.5}}),
                        fracture("edge", {{3, 1}, {4, 1}})};
  return generate_mesh(geometry, {.size = size});
}

}  // namespace sprekk::test
