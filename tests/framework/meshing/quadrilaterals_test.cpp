// Meshes with cells of four corners: their geometry, where they come from, and what becomes of them.
#include <random>

#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/plane/cell_shape.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/mesh/quality/cell_angles.hpp"
#include "framework/mesh/quality/mesh_quality.hpp"
#include "framework/mesh/search/point_location.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "framework/meshing/single_cell_corners.hpp"
#include "framework/remeshing/overlap.hpp"
#include "tests/framework/remeshing/growth_checks.hpp"

namespace sprekk::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Kind = MeshOptions::Kind;
using Shape = MeshOptions::Shape;

MeshOptions rectangles(int columns, int rows) {
  return {.kind = Kind::structured, .shape = Shape::quadrilaterals, .cells = {columns, rows}};
}

int quadrilateral_count(const Mesh& mesh) {
  int count = 0;
  for (const Ring& cell : mesh.cell_nodes) count += cell.size() == 4 ? 1 : 0;
  return count;
}

TEST(Ring, IsARangeOfThreeOrFourNumbersInACircle) {
  Ring three(5, 0, 7), four(5, 0, 7, 2);
  EXPECT_EQ(std::vector<int>(three.begin(), three.end()), (std::vector{5, 0, 7}));
  EXPECT_EQ(std::vector<int>(four.begin(), four.end()), (std::vector{5, 0, 7, 2}));
  EXPECT_EQ(three.after(2), 5);
  EXPECT_EQ(four.after(2), 2);
  EXPECT_EQ(four.after(3), 5);
  EXPECT_EQ(three.before(0), 7);
  EXPECT_EQ(four.before(0), 2);
  three.turn(), four.turn();
  EXPECT_EQ(three, Ring(5, 7, 0));
  EXPECT_EQ(four, Ring(5, 2, 7, 0));
  EXPECT_EQ(sizeof(Ring), 4 * sizeof(int));
}

TEST(CellShape, OfATrapezoidFarFromTheOrigin) {
  // Parallel sides 3 and 1, height 2: the centre is at height h/3 (a + 2 b)/(a + b) = 5/6, and by symmetry on x = 1.5.
  const Point away(1e6, -3e6);
  std::vector<Point> nodes;
  for (const Point& x : {Point(0, 0), Point(3, 0), Point(2, 2), Point(1, 2)}) nodes.push_back(away + x);
  const Ring corners(0, 1, 2, 3);
  EXPECT_NEAR(signed_area(nodes, corners), 4, 1e-12);
  EXPECT_NEAR((centroid(nodes, corners) - away - Point(1.5, 5.0 / 6)).norm(), 0, 1e-9);
  EXPECT_NEAR(smallest_corner_area(nodes, corners), 1, 1e-12);
  const auto [smallest, largest] = angles(nodes, corners);
  EXPECT_NEAR(smallest, std::atan(2.0), 1e-12);
  EXPECT_NEAR(largest, std::numbers::pi - std::atan(2.0), 1e-12);
}

TEST(Quadrilaterals, OneByOne) {
  const Mesh mesh = generate_mesh(box(-1, 2, 0, 2), rectangles(3, 4));
  expect_consistent(mesh);
  EXPECT_EQ(mesh.cell_count(), 12);
  EXPECT_EQ(mesh.face_count(), 3 * 5 + 4 * 4);
  EXPECT_EQ(mesh.node_count(), 20);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    EXPECT_EQ(mesh.cell_center[c], Point(-0.5 + c % 3, 0.25 + 0.5 * (c / 3)));
    EXPECT_EQ(mesh.cell_measure[c], 0.5);
  }
  const MeshQuality quality = mesh_quality(mesh);
  EXPECT_NEAR(quality.smallest_angle, 90 * degree, 1e-12);
  EXPECT_NEAR(quality.largest_angle, 90 * degree, 1e-12);
  EXPECT_EQ(quality.cells_with_one_neighbour, 0);
}

Geometry fractured_box() {
  Geometry geometry = box(0, 1, 0, 1);
  geometry.fractures = {fracture("bent", {{0.2, 0.3}, {0.6, 0.3}, {0.6, 0.7}}),
                        fracture("edge", {{0, 0.9}, {0.5, 0.9}})};
  geometry.regions = {region("layer", {{0, 0.5}, {1, 0.5}, {1, 1}, {0, 1}})};
  return geometry;
}

TEST(Quadrilaterals, SplitAlongFracturesOnGridLines) {
  for (const double distortion : {0.0, 0.4}) {
    MeshOptions options = rectangles(10, 10);
    options.distortion = distortion;
    const Mesh mesh = generate_mesh(fractured_box(), options);
    expect_consistent(mesh);
    EXPECT_EQ(quadrilateral_count(mesh), 100);
    EXPECT_EQ(mesh.fractures[0].cell_count, 8);
    EXPECT_EQ(mesh.fractures[1].cell_count, 5);
    EXPECT_NEAR(total_area(mesh), 1, 1e-13);
    EXPECT_EQ(component_count(mesh), 1);
    EXPECT_EQ(euler_characteristic(mesh), 0);
    for (int c = 0; c < 100; ++c) EXPECT_EQ(mesh.cell_region[c], c < 50 ? 0 : 1);
    for (const Ring& cell : mesh.cell_nodes) EXPECT_GT(smallest_corner_area(mesh.nodes, cell), 0.2 * 0.005 * 0.999);
    // And back.
    const Mesh again = build_mesh(to_raw_mesh(mesh));
    EXPECT_EQ(again.cell_nodes, mesh.cell_nodes);
  }
}

TEST(Quadrilaterals, HaveNoDiagonalsForFractures) {
  Geometry geometry = box(0, 1, 0, 1);
  geometry.fractures = {fracture("slanted", {{0.2, 0.2}, {0.5, 0.5}})};
  EXPECT_EQ(generate_mesh(geometry, {.kind = Kind::structured, .cells = {10, 10}}).fracture_cell_count(), 3);
  EXPECT_THAT(input_error([&] { generate_mesh(geometry, rectangles(10, 10)); }),
              AllOf(HasSubstr("'slanted' does not follow the structured mesh"), Not(HasSubstr("diagonals"))));
}

TEST(Quadrilaterals, MadeOfTrianglesConformAndAreConvex) {
  Geometry geometry = box(0, 2, 0, 1);
  geometry.fractures = {fracture("kinked", {{0.4, 0.3}, {0.9, 0.5}, {1.2, 0.8}}),
                        fracture("edge", {{2, 0.4}, {1.5, 0.3}})};
  geometry.regions = {region("lens", {{0.2, 0.6}, {0.7, 0.7}, {0.4, 0.9}})};
  for (const double distortion : {0.0, 0.3}) {
    const Mesh mesh = generate_mesh(
        geometry, {.shape = Shape::quadrilaterals, .size = 0.08, .fracture_size = 0.03, .distortion = distortion});
    expect_consistent(mesh);
    EXPECT_NEAR(total_area(mesh), 2, 1e-12);
    // Three quarters of the triangles have found a partner.
    const int joined = 2 * quadrilateral_count(mesh), all = mesh.cell_count() + quadrilateral_count(mesh);
    EXPECT_GT(joined, 0.75 * all);
    for (const Ring& cell : mesh.cell_nodes) EXPECT_GT(smallest_corner_area(mesh.nodes, cell), 0);
    EXPECT_EQ(mesh_quality(mesh).cells_with_one_neighbour, 0);
    for (const Ridge& point : mesh.ridges) {
      if (point.kind != Ridge::Kind::tip) continue;
      const auto node = std::find(mesh.nodes.begin(), mesh.nodes.end(), point.center) - mesh.nodes.begin();
      EXPECT_GE(mesh.node_cells[static_cast<int>(node)].size(), 5u);
      for (const int cell : mesh.node_cells[static_cast<int>(node)]) EXPECT_EQ(mesh.cell_nodes[cell].size(), 3);
    }
    if (distortion == 0) {
      EXPECT_GT(mesh_quality(mesh).smallest_angle, 20 * degree);
      EXPECT_LE(mesh_quality(mesh).largest_angle, 140 * degree + 1e-12);
    }
  }
}

RawMesh one_quadrilateral(const std::vector<Point>& nodes) {
  return {.nodes = nodes,
          .cells = {{0, 1, 2, 3}},
          .regions = {0},
          .region_names = {"rock"},
          .boundary_faces = {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 3}, 0}, {{3, 0}, 0}},
          .side_names = {"outside"},
          .fractures = {}};
}

TEST(Quadrilaterals, OfEitherOrientationAreTakenAndOthersRefused) {
  EXPECT_EQ(build_mesh(one_quadrilateral({{0, 0}, {0, 1}, {1, 1}, {1, 0}})).cell_nodes[0], Ring(0, 3, 2, 1));
  const std::vector<std::vector<Point>> bad = {{{0, 0}, {1, 0}, {0.2, 0.2}, {0, 1}},  // an arrowhead
                                               {{0, 0}, {1, 1}, {1, 0}, {0, 1}},      // crosses itself
                                               {{0, 0}, {1, 0}, {0.5, 0.5}, {0, 1}},  // a corner of 180 degrees
                                               {{0, 0}, {0, 0}, {1, 0}, {0, 1}},      // two corners in one
                                               {{0, 0}, {1, 0}, {2, 0}, {3, 0}},      // on a line
                                               {{0, 0}, {1, 0}, {std::nan(""), 1}, {0, 1}}};
  for (const auto& nodes : bad)
    EXPECT_THAT(input_error([&] { build_mesh(one_quadrilateral(nodes)); }), HasSubstr("is not convex"));
}

TEST(Quadrilaterals, ALoneTriangleInACornerIsHalvedTogetherWithTheQuadrilateralBehindIt) {
  // The triangle 0 1 2 has two outer edges; behind its third one lies a quadrilateral of another region.
  RawMesh raw{.nodes = {{0, 0}, {1, 0}, {1, 1}, {0.4, 1.4}, {-0.3, 0.8}},
              .cells = {{0, 1, 2}, {3, 4, 0, 2}},
              .regions = {0, 1},
              .region_names = {"rock", "other"},
              .boundary_faces = {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 3}, 0}, {{3, 4}, 0}, {{4, 0}, 0}},
              .side_names = {"outside"},
              .fractures = {}};
  const double area = total_area(build_mesh(raw));
  EXPECT_EQ(avoid_single_cell_corners(raw), 1);
  const Mesh mesh = build_mesh(raw);
  expect_consistent(mesh);
  EXPECT_EQ(mesh.cell_count(), 5);
  EXPECT_EQ(quadrilateral_count(mesh), 0);
  EXPECT_NEAR(total_area(mesh), area, 1e-14);
  EXPECT_EQ(std::count(mesh.cell_region.begin(), mesh.cell_region.end(), 1), 3);
  EXPECT_EQ(mesh_quality(mesh).cells_with_one_neighbour, 0);
}

TEST(Quadrilaterals, PointsAreFoundInThem) {
  MeshOptions options = rectangles(10, 10);
  options.distortion = 0.4;
  const Mesh mesh = generate_mesh(fractured_box(), options);
  const PointLocation location(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(0, 1);
  for (int i = 0; i < 5000; ++i) {
    const Point x(coordinate(random), coordinate(random));
    const int cell = location.cell_at(x);
    ASSERT_NE(cell, none);
    std::vector<Point> polygon;
    for (const int node : mesh.cell_nodes[cell]) polygon.push_back(mesh.nodes[node]);
    ASSERT_TRUE(is_inside(x, polygon));
  }
}

TEST(Quadrilaterals, OverlapsOfTwoMeshesCoverBoth) {
  // A square of side 1 turned by 45 degrees about the centre of another: a regular octagon of area 2 (sqrt 2 - 1).
  const double r = std::sqrt(0.5);
  EXPECT_NEAR(common_area({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}, {{r, 0}, {0, r}, {-r, 0}, {0, -r}}),
              2 * (std::sqrt(2.0) - 1), 1e-14);
  const auto corners = [](const Mesh& mesh) {
    std::vector<Corners> all;
    for (const Ring& c : mesh.cell_nodes) {
      const auto at = [&](int k) { return mesh.nodes[c[k]]; };
      all.push_back(c.size() == 3 ? Corners(at(0), at(1), at(2)) : Corners(at(0), at(1), at(2), at(3)));
    }
    return all;
  };
  MeshOptions distorted = rectangles(7, 5);
  distorted.distortion = 0.3;
  const Mesh one = generate_mesh(box(0, 1, 0, 1), distorted), other = generate_mesh(box(0, 1, 0, 1), {.size = 0.15});
  std::vector<double> of_one(one.cell_count()), of_other(other.cell_count());
  for_each_overlap(corners(one), corners(other), [&](int i, int j, double area) {
    of_one[i] += area;
    of_other[j] += area;
  });
  for (int i = 0; i < one.cell_count(); ++i) EXPECT_NEAR(of_one[i], one.cell_measure[i], 1e-14);
  for (int j = 0; j < other.cell_count(); ++j) EXPECT_NEAR(of_other[j], other.cell_measure[j], 1e-14);
}

TEST(Quadrilaterals, GiveWayToTrianglesWhereAFractureGrows) {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = {fracture("main", {{0.8, 1}, {1.2, 1}})};
  const double size = 0.05;
  for (const MeshOptions& options :
       {rectangles(40, 40), MeshOptions{.shape = Shape::quadrilaterals, .size = 0.1, .fracture_size = size}}) {
    const Mesh mesh = generate_mesh(geometry, options);
    const CavityOptions cavity{.radius = 5 * size, .size = size, .growth = 0.3};
    for (const double angle : {0.0, 35.0, -70.0}) {
      const GrownMesh grown = extend_fractures(mesh, {straight(mesh, 0, true, 2 * size, angle * degree)}, cavity);
      expect_sound(mesh, grown);
      EXPECT_GT(quadrilateral_count(grown.mesh), 0.7 * quadrilateral_count(mesh));
      EXPECT_GE(grown.smallest_angle, 30 * degree) << angle;
      // And on, from the mixed mesh.
      expect_sound(grown.mesh, extend_fractures(grown.mesh,
                                                {straight(grown.mesh, 0, true, 3 * size, -20 * degree),
                                                 straight(grown.mesh, 0, false, size, 0)},
                                                cavity));
    }
  }
}

}  // namespace
}  // namespace sprekk::test
