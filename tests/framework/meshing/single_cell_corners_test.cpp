#include "framework/meshing/single_cell_corners.hpp"

#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/quality/mesh_quality.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

/// A grid of nx x ny unit squares whose diagonals all rise, so that two corners hold one triangle each.
RawMesh rising(int nx, int ny) {
  RawMesh mesh;
  mesh.region_names = {"rock", "other"};
  mesh.side_names = {"outside"};
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) mesh.nodes.emplace_back(i, j);
  }
  const auto node = [&](int i, int j) { return j * (nx + 1) + i; };
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      mesh.cells.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      mesh.cells.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  }
  mesh.regions.assign(mesh.cells.size(), 0);
  for (int i = 0; i < nx; ++i) {
    mesh.boundary_faces.push_back({{node(i, 0), node(i + 1, 0)}, 0});
    mesh.boundary_faces.push_back({{node(i, ny), node(i + 1, ny)}, 0});
  }
  for (int j = 0; j < ny; ++j) {
    mesh.boundary_faces.push_back({{node(0, j), node(0, j + 1)}, 0});
    mesh.boundary_faces.push_back({{node(nx, j), node(nx, j + 1)}, 0});
  }
  return mesh;
}

void expect_cured(const RawMesh& raw, double area) {
  const Mesh mesh = build_mesh(raw);
  expect_consistent(mesh);
  EXPECT_EQ(mesh_quality(mesh).cells_with_one_neighbour, 0);
  EXPECT_NEAR(total_area(mesh), area, 1e-13);
}

TEST(SingleCellCorners, FlipsTheInnerEdge) {
  RawMesh mesh = rising(3, 3);
  EXPECT_EQ(mesh_quality(build_mesh(mesh)).cells_with_one_neighbour, 2);
  EXPECT_EQ(avoid_single_cell_corners(mesh), 2);
  EXPECT_EQ(mesh.cells.size(), 18u);
  EXPECT_EQ(mesh.nodes.size(), 16u);
  expect_cured(mesh, 9);
  EXPECT_EQ(avoid_single_cell_corners(mesh), 0);
}

TEST(SingleCellCorners, HalvesTheEdgeWhereAFlipOnlyMovesTheTrouble) {
  RawMesh mesh = rising(1, 1);
  EXPECT_EQ(avoid_single_cell_corners(mesh), 1);
  EXPECT_EQ(mesh.cells.size(), 4u);
  expect_cured(mesh, 1);
}

TEST(SingleCellCorners, HalvesTheEdgeBetweenRegions) {
  RawMesh mesh = rising(3, 3);
  mesh.regions[4] = 1;  // the lower right corner
  avoid_single_cell_corners(mesh);
  EXPECT_EQ(mesh.cells.size(), 20u);
  expect_cured(mesh, 9);
  const Mesh built = build_mesh(mesh);
  double area = 0;
  for (int c = 0; c < built.cell_count(); ++c) area += built.cell_region[c] == 1 ? built.cell_measure[c] : 0;
  EXPECT_NEAR(area, 0.5, 1e-15);
}

TEST(SingleCellCorners, SeesFracturesAsWalls) {
  // The triangle right of (1, 1)–(2, 1)–(2, 2) lies in the kink of the fracture.
  RawMesh mesh = rising(3, 3);
  mesh.fractures = {{"kinked", {5, 6, 10}}};
  EXPECT_EQ(mesh_quality(build_mesh(mesh)).cells_with_one_neighbour, 3);
  EXPECT_EQ(avoid_single_cell_corners(mesh), 3);
  expect_cured(mesh, 9);
  EXPECT_NEAR(fracture_length(build_mesh(mesh), 0), 2, 1e-15);
}

TEST(SingleCellCorners, LeavesALonelyTriangle) {
  RawMesh mesh{.nodes = {{0, 0}, {1, 0}, {0, 1}},
               .cells = {{0, 1, 2}},
               .regions = {0},
               .region_names = {"rock"},
               .boundary_faces = {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 0}, 0}},
               .side_names = {"outside"},
               .fractures = {}};
  EXPECT_EQ(avoid_single_cell_corners(mesh), 0);
  EXPECT_EQ(mesh.cells.size(), 1u);
}

TEST(SingleCellCorners, DividesCellsThatFracturesEnclose) {
  // A triangle and, in a mesh with a quadrilateral, that.
  RawMesh raw = rising(4, 4);
  const auto node = [](int i, int j) { return j * 5 + i; };
  raw.fractures = {
      {"flat", {node(1, 1), node(2, 1)}}, {"up", {node(2, 1), node(2, 2)}}, {"across", {node(1, 1), node(2, 2)}}};
  EXPECT_GT(avoid_single_cell_corners(raw), 0);
  expect_cured(raw, 16);

  RawMesh square = rising(4, 4);
  const std::size_t first = 2 * (4 + 1);
  ASSERT_EQ(square.cells[first][0], node(1, 1));
  square.cells[first] = {node(1, 1), node(2, 1), node(2, 2), node(1, 2)};
  square.cells.erase(square.cells.begin() + first + 1);
  square.regions.pop_back();
  square.fractures = {{"lower", {node(1, 1), node(2, 1), node(2, 2)}}, {"upper", {node(2, 2), node(1, 2), node(1, 1)}}};
  const std::size_t before = square.cells.size();
  EXPECT_GT(avoid_single_cell_corners(square), 0);
  EXPECT_GE(square.cells.size(), before + 3);
  expect_cured(square, 16);
}

}  // namespace
}  // namespace sprekk::test
