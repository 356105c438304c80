#include "framework/mesh/search/point_location.hpp"

#include <random>

#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

TEST(PointLocation, FindsEveryCellByItsCentre) {
  const Mesh mesh = generate_mesh(paper_geometry(), {.size = 0.1, .tip_size = 0.001});
  const PointLocation location(mesh);
  for (int c = 0; c < mesh.cell_count(); ++c) ASSERT_EQ(location.cell_at(mesh.cell_center[c]), c);
}

TEST(PointLocation, FindsRandomPointsAndNothingOutside) {
  const Mesh mesh = generate_mesh(paper_geometry(), {.size = 0.15, .fracture_size = 0.01});
  const PointLocation location(mesh);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-0.5, 2.5);
  for (int i = 0; i < 20000; ++i) {
    const Point x(coordinate(random), coordinate(random));
    const int cell = location.cell_at(x);
    const bool is_in_box = x.minCoeff() >= 0 && x.maxCoeff() <= 2;
    ASSERT_EQ(cell != none, is_in_box);
    if (cell == none) continue;
    for (int k = 0; k < 3; ++k) {
      const Point &a = mesh.nodes[mesh.cell_nodes[cell][k]], &b = mesh.nodes[mesh.cell_nodes[cell][(k + 1) % 3]];
      ASSERT_GE(signed_area(a, b, x), -1e-12);
    }
  }
  EXPECT_EQ(location.cell_at({std::nan(""), 1}), none);
}

TEST(PointLocation, AGuessChangesNoAnswer) {
  const Mesh mesh = generate_mesh(paper_geometry(), {.size = 0.15, .fracture_size = 0.01});
  const PointLocation location(mesh);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(-0.1, 1.1);
  const auto compare = [&](const Point& x, int near) {
    const int cell = location.cell_at(x);
    ASSERT_EQ(location.cell_at(x, near), cell);
    ASSERT_EQ(location.cell_at(x, none), cell);
    ASSERT_EQ(location.cell_at(x, cell), cell);
  };
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Ring& corners = mesh.cell_nodes[c];
    const Point &a = mesh.nodes[corners[0]], &b = mesh.nodes[corners[1]], &d = mesh.nodes[corners[2]];
    compare(a, c);
    compare(0.5 * (a + b), c);
    for (int i = 0; i < 5; ++i) compare(a + part(random) * (b - a) + part(random) * (d - a), c);
  }
}

TEST(PointLocation, CornersOfTheBoxAreInside) {
  const Mesh mesh = generate_mesh(box(-3, 5, 100, 104), {.size = 1});
  const PointLocation location(mesh);
  for (const Point& corner : {Point(-3, 100), Point(5, 100), Point(5, 104), Point(-3, 104)}) {
    EXPECT_NE(location.cell_at(corner), none);
  }
}

TEST(NearestFractureCell, IsTheOneBelowThePoint) {
  Geometry geometry = box(0, 10, 0, 10);
  geometry.fractures = {fracture("one", {{1, 2}, {9, 2}}), fracture("two", {{1, 8}, {9, 8}})};
  const Mesh mesh = generate_mesh(geometry, {.size = 1});
  EXPECT_EQ(find_fracture(mesh, "two"), 1);
  EXPECT_EQ(find_fracture(mesh, "three"), none);
  const auto of = [&](int fracture) {
    return [&, fracture](int cell) { return mesh.fracture_cells[cell].fracture == fracture; };
  };
  for (double x = 1.05; x < 9; x += 0.3) {
    const int cell = nearest_fracture_cell(mesh, {x, 3}, of(1));
    EXPECT_EQ(mesh.fracture_cells[cell].fracture, 1);
    EXPECT_LE(std::abs(mesh.fracture_cells[cell].center.x() - x), 0.5 * mesh.fracture_cells[cell].measure + 1e-12);
  }
  EXPECT_EQ(nearest_fracture_cell(mesh, {0, 0}, of(0)), mesh.fractures[0].first_cell);
  EXPECT_EQ(nearest_fracture_cell(mesh, {0, 0}), mesh.fractures[0].first_cell);
  EXPECT_EQ(nearest_fracture_cell(mesh, {0, 0}, [](int) { return false; }), none);
  // Round-off does not choose between cells that meet at a node.
  const FractureCell& first = mesh.fracture_cells[mesh.fractures[0].first_cell];
  const Point node = mesh.ridges[first.ridges[1]].center;
  for (const double off : {-1e-9, 0.0, 1e-9})
    EXPECT_EQ(nearest_fracture_cell(mesh, node + Point(off, off)), mesh.fractures[0].first_cell);
}

}  // namespace
}  // namespace sprekk::test
