#include "framework/discretization/ends_nearby.hpp"

#include <gtest/gtest.h>

#include <set>

#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

/// The nodes that have a tip nearby; none of them behind a fracture, as seen from the tip.
std::set<int> nodes_near_tips(const Mesh& mesh) {
  const std::vector<int> tips = ends_nearby(mesh);
  std::set<int> near;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (tips[node] == none) continue;
    near.insert(node);
    const Segment way{mesh.nodes[node], mesh.nodes[tips[node]]};
    for (const FractureCell& cell : mesh.fracture_cells) {
      const Point half = 0.5 * cell.measure * cell.tangents;
      if (std::abs((way.to - cell.center).dot(cell.normal)) < 1e-9) continue;  // the tip's own: straight
      Point where;
      EXPECT_FALSE(cross_inside(way, {cell.center - half, cell.center + half}, where))
          << way.from.transpose() << " to " << way.to.transpose() << " crosses at " << where.transpose();
    }
  }
  return near;
}

Geometry stub() {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = {fracture("a", {{0, 1}, {1.25, 1}}), fracture("b", {{1, 0.25}, {1, 1.75}})};
  return geometry;
}

TEST(TipsNearby, AreNotBehindAFractureThatCrosses) {
  const MeshOptions options{.kind = MeshOptions::Kind::structured, .cells = {16, 16}};
  const Mesh mesh = generate_mesh(stub(), options);
  ASSERT_EQ(mesh.junctions.size(), 1u);
  int beyond = 0;
  for (const int node : nodes_near_tips(mesh)) {
    const Point& x = mesh.nodes[node];
    if (std::abs(x.y() - 1) < 0.3) {
      EXPECT_GT(x.x(), 1 + 1e-9);
      ++beyond;
    }
  }
  EXPECT_GT(beyond, 10);
  // The same tip without the other fracture has nodes on both walls further back.
  Geometry alone = stub();
  alone.fractures.pop_back();
  double least = 2;
  const Mesh uncrossed = generate_mesh(alone, options);
  for (const int node : nodes_near_tips(uncrossed)) least = std::min(least, uncrossed.nodes[node].x());
  EXPECT_LT(least, 1 - 1e-9);
}

TEST(TipsNearby, AreNotBehindAFractureOnUnstructuredMeshes) {
  for (const double size : {0.2, 0.1, 0.05}) {
    Geometry geometry = stub();
    geometry.fractures.push_back(fracture("c", {{1, 0.6}, {1.12, 0.8}}));
    geometry.fractures.push_back(fracture("d", {{1.31, 0.9}, {1.28, 1.2}}));
    const Mesh mesh = generate_mesh(geometry, {.size = size});
    ASSERT_EQ(mesh.junctions.size(), 2u);
    EXPECT_FALSE(nodes_near_tips(mesh).empty());
  }
}

TEST(TipsNearby, AnEndOnAnotherFractureIsNone) {
  Geometry geometry = box(0, 2, 0, 2);
  // A T and a corner, between fractures that end on the sides: no tip anywhere.
  geometry.fractures = {fracture("a", {{0, 1}, {2, 1}}), fracture("b", {{1, 1}, {1.2, 2}}),
                        fracture("c", {{0.4, 0}, {0.7, 0.5}}), fracture("d", {{0.7, 0.5}, {2, 0.3}})};
  EXPECT_TRUE(nodes_near_tips(generate_mesh(geometry, {.size = 0.2})).empty());
}

}  // namespace
}  // namespace sprekk::test
