#include "framework/mesh/topology_hash.hpp"

#include <gtest/gtest.h>

#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

TEST(TopologyHash, DependsOnCornersAndFracturesAlone) {
  Geometry geometry = box(0, 1, 0, 1);
  geometry.fractures = {fracture("main", {{0.3, 0.5}, {0.7, 0.5}})};
  const Mesh mesh = generate_mesh(geometry, {.size = 0.2, .fracture_size = 0.1});
  const std::uint64_t hash = topology_hash(mesh);
  Mesh other = mesh;
  for (Point& x : other.nodes) x *= 1.01;
  for (int& rank : other.cell_rank) rank = 1;
  EXPECT_EQ(topology_hash(other), hash);
  std::swap(other.cell_nodes[0], other.cell_nodes[1]);
  EXPECT_NE(topology_hash(other), hash);
  other = mesh;
  std::swap(other.fracture_cells[0].ridges[0], other.fracture_cells[0].ridges[1]);
  EXPECT_NE(topology_hash(other), hash);
  other = mesh;
  other.fracture_cells.pop_back();
  EXPECT_NE(topology_hash(other), hash);
}

}  // namespace
}  // namespace sprekk::test
