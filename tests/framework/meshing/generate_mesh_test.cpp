#include "framework/meshing/generate_mesh.hpp"

#include <ctime>

#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/mesh/quality/mesh_quality.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

using Kind = MeshOptions::Kind;

/// Kinks, ends on two sides, fractures across and along region boundaries, regions along box sides.
Geometry busy_geometry() {
  Geometry geometry = box(-1, 3, 0, 2);
  geometry.fractures = {fracture("kinked", {{-0.3, 0.3}, {0.2, 0.5}, {0.4, 0.9}}),
                        fracture("edge", {{3, 1.2}, {2.2, 1.1}}), fracture("across", {{0.5, 1.2}, {0.9, 1.9}}),
                        fracture("through", {{2, 0}, {2.2, 0.5}, {3, 0.6}}),
                        fracture("along", {{1.2, 1.6}, {1.8, 1.6}})};
  geometry.fractures[2].size = 0.02;
  geometry.regions = {region("layer", {{-1, 1.6}, {3, 1.6}, {3, 2}, {-1, 2}}),
                      region("lens", {{0.7, 0.4}, {0.7, 0.9}, {1.5, 0.4}})};
  return geometry;
}

TEST(GenerateMesh, PaperGeometryIsOfGoodQuality) {
  const Mesh mesh = generate_mesh(paper_geometry(), {.size = 0.02, .fracture_size = 0.005});
  expect_consistent(mesh);
  const MeshQuality quality = mesh_quality(mesh);
  EXPECT_GT(quality.smallest_angle, 20 * degree);
  EXPECT_EQ(quality.cells_with_one_neighbour, 0);
  EXPECT_NEAR(quality.measure, 4, 1e-12);
  EXPECT_NEAR(quality.fracture_measure, 0.1, 1e-14);
  EXPECT_EQ(quality.fracture_cells, 20);
  EXPECT_EQ(mesh.side_names, (std::vector<std::string>{"left", "right", "bottom", "top"}));
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"medium"});
  EXPECT_EQ(euler_characteristic(mesh), 0);
}

TEST(GenerateMesh, NamesTheSidesOfTheBox) {
  const Mesh mesh = generate_mesh(box(1, 4, -2, 0), {.size = 0.3});
  std::array<double, 4> length{};
  const std::array<Point, 4> outward = {Point(-1, 0), Point(1, 0), Point(0, -1), Point(0, 1)};
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face_side[f] == none) continue;
    length[mesh.face_side[f]] += mesh.face_measure[f];
    EXPECT_NEAR((mesh.face_normal[f] - outward[mesh.face_side[f]]).norm(), 0, 1e-12);
  }
  EXPECT_NEAR(length[0], 2, 1e-12);
  EXPECT_NEAR(length[1], 2, 1e-12);
  EXPECT_NEAR(length[2], 3, 1e-12);
  EXPECT_NEAR(length[3], 3, 1e-12);
}

TEST(GenerateMesh, ConformsToFracturesAndRegions) {
  const Geometry geometry = busy_geometry();
  const Mesh mesh = generate_mesh(geometry, {.size = 0.1, .fracture_size = 0.05});
  expect_consistent(mesh);
  EXPECT_NEAR(total_area(mesh), 8, 1e-12);
  EXPECT_EQ(component_count(mesh), 2);
  // One hole for each of the three fractures inside; the ones that end on the boundary make none.
  EXPECT_EQ(euler_characteristic(mesh), 2 - 3);
  EXPECT_EQ(mesh_quality(mesh).cells_with_one_neighbour, 0);
  ASSERT_EQ(mesh.fractures.size(), geometry.fractures.size());
  for (std::size_t i = 0; i < mesh.fractures.size(); ++i) {
    const auto& points = geometry.fractures[i].points;
    double length = 0;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) length += (points[k + 1] - points[k]).norm();
    EXPECT_NEAR(fracture_length(mesh, static_cast<int>(i)), length, 1e-13);
    const auto& [name, first, count] = mesh.fractures[i];
    EXPECT_EQ(name, geometry.fractures[i].name);
    EXPECT_EQ(mesh.ridges[mesh.fracture_cells[first].ridges[0]].center, points.front());
    EXPECT_EQ(mesh.ridges[mesh.fracture_cells[first + count - 1].ridges[1]].center, points.back());
  }
  std::array<double, 3> area{};
  for (int c = 0; c < mesh.cell_count(); ++c) area[mesh.cell_region[c]] += mesh.cell_measure[c];
  EXPECT_NEAR(area[1], 1.6, 1e-12);
  EXPECT_NEAR(area[2], 0.2, 1e-12);
  EXPECT_NEAR(area[0], 8 - 1.8, 1e-12);
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"medium", "layer", "lens"}));
}

TEST(GenerateMesh, EndsOnTheBoundaryKnowTheirSide) {
  const Mesh mesh = generate_mesh(busy_geometry(), {.size = 0.2});
  const auto end = [&](int fracture, bool last) -> const Ridge& {
    const auto& [name, first, count] = mesh.fractures[fracture];
    return mesh.ridges[mesh.fracture_cells[last ? first + count - 1 : first].ridges[last ? 1 : 0]];
  };
  EXPECT_EQ(end(0, false).kind, Ridge::Kind::tip);
  EXPECT_EQ(mesh.side_names[end(1, false).side], "right");
  EXPECT_EQ(end(1, true).kind, Ridge::Kind::tip);
  EXPECT_EQ(mesh.side_names[end(3, false).side], "bottom");
  EXPECT_EQ(mesh.side_names[end(3, true).side], "right");
}

TEST(GenerateMesh, GradingReachesTheSizesAskedFor) {
  const double tip_size = 0.001, fracture_size = 0.004, size = 0.05;
  const Mesh mesh =
      generate_mesh(paper_geometry(), {.size = size, .fracture_size = fracture_size, .tip_size = tip_size});
  const auto mean_length_near = [&](const Point& x, double radius) {
    double sum = 0;
    int count = 0;
    for (int f = 0; f < mesh.face_count(); ++f) {
      if ((mesh.face_center[f] - x).norm() > radius) continue;
      sum += mesh.face_measure[f];
      ++count;
    }
    EXPECT_GT(count, 3);
    return sum / count;
  };
  const auto& [name, first, count] = mesh.fractures[0];
  for (const int point : {mesh.fracture_cells[first].ridges[0], mesh.fracture_cells[first + count - 1].ridges[1]}) {
    EXPECT_NEAR(mean_length_near(mesh.ridges[point].center, tip_size), tip_size, 0.3 * tip_size);
  }
  EXPECT_NEAR(mean_length_near({1, 1}, fracture_size), fracture_size, 0.3 * fracture_size);
  EXPECT_NEAR(mean_length_near({0.4, 1.6}, 4 * size), size, 0.3 * size);
}

TEST(GenerateMesh, SmallAndLargeBoxesFarFromTheOrigin) {
  const Mesh reference = generate_mesh(paper_geometry(), {.size = 0.1, .fracture_size = 0.01});
  // Powers of two, so that the scaled input has the same digits.
  for (const double scale : {std::exp2(-20), 1.0, std::exp2(20)}) {
    for (const double offset : {0.0, std::exp2(20)}) {
      Geometry geometry = paper_geometry();
      const auto move = [&](Point& x) { x = scale * (x + Point(offset, offset)); };
      move(geometry.box.low);
      move(geometry.box.high);
      for (Point& x : geometry.fractures[0].points) move(x);
      const Mesh mesh = generate_mesh(geometry, {.size = scale * 0.1, .fracture_size = scale * 0.01});
      const MeshQuality quality = mesh_quality(mesh);
      EXPECT_EQ(quality.fracture_cells, reference.fracture_cell_count());
      EXPECT_NEAR(quality.cells, reference.cell_count(), 0.02 * reference.cell_count());
      EXPECT_GT(quality.smallest_angle, 20 * degree);
      EXPECT_NEAR(quality.measure / (scale * scale), 4, 1e-8);
      EXPECT_EQ(mesh.ridges.front().center, geometry.fractures[0].points.front());
      EXPECT_EQ(mesh.ridges.back().center, geometry.fractures[0].points.back());
    }
  }
}

/// A line of `edges` cells at `angle` (rad) in a box that is `ratio` cells wide.
Mesh small_line_in_a_large_box(double ratio, int edges, double angle, const Point& offset, double size) {
  Geometry geometry;
  geometry.box.low = offset - 0.5 * Point(size, size);
  geometry.box.high = offset + 0.5 * Point(size, size);
  const double edge = size / ratio;
  const Point center = offset + size * Point(0.03, -0.07),
              along = 0.5 * edges * edge * Point(std::cos(angle), std::sin(angle));
  geometry.fractures = {fracture("line", {center - along, center + along})};
  return generate_mesh(geometry, {.size = 0.1 * size, .fracture_size = edge, .growth = 0.3});
}

TEST(GenerateMesh, SmallObliqueLinesInLargeBoxes) {
  for (const double ratio : {3e4, 5e4, 1e5, 3e5}) {
    for (int i = 0; i < 5; ++i) {
      const double angle = 0.07 + 0.61 * i, size = i % 3 == 0 ? 200 : i % 3 == 1 ? 0.03 : 7e4;
      const Point offset = i % 2 == 0 ? Point(0, 0) : Point(3.7 * size, -1.1 * size);
      SCOPED_TRACE(testing::Message() << ratio << " edges wide, " << size << " m, angle " << angle);
      const Mesh mesh = small_line_in_a_large_box(ratio, 20, angle, offset, size);
      EXPECT_NEAR(total_area(mesh), size * size, 1e-10 * size * size);
      EXPECT_NEAR(fracture_length(mesh, 0), 20 * size / ratio, 1e-5 * size / ratio);
      EXPECT_EQ(euler_characteristic(mesh), 0);
      EXPECT_GT(mesh_quality(mesh).smallest_angle, 15 * degree);
    }
  }
}

TEST(GenerateMesh, SaysWhenABoxIsTooLargeForItsEdges) {
  int refused = 0;
  for (int i = 0; i < 8; ++i) {
    const auto make = [&] { small_line_in_a_large_box(1e6, 12, 0.3 + 0.37 * i, {0, 0}, 1); };
    try {
      make();
    } catch (const InputError& error) {
      ++refused;
      EXPECT_THAT(error.what(), testing::HasSubstr("edges of 1e-06 m in a box of 1 m"));
      EXPECT_THAT(error.what(), testing::HasSubstr("so that the box is at most 300,000 edges wide"));
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(GenerateMesh, IsDeterministic) {
  for (const Kind kind : {Kind::unstructured, Kind::structured}) {
    Geometry geometry = box(0, 2, 0, 2);
    geometry.fractures = {fracture("main", {{0.8, 0.8}, {1.2, 1.2}})};
    const MeshOptions options{.kind = kind, .size = 0.1, .distortion = 0.2, .seed = 3};
    const Mesh one = generate_mesh(geometry, options), two = generate_mesh(geometry, options);
    EXPECT_EQ(one.nodes, two.nodes);
    EXPECT_EQ(one.cell_nodes, two.cell_nodes);
    EXPECT_EQ(one.face_nodes, two.face_nodes);
    EXPECT_NE(one.version, two.version);
  }
}

TEST(GenerateMesh, TheModelBeforeLeavesNoTrace) {
  const MeshOptions options{.size = 0.2};
  const Mesh one = generate_mesh(busy_geometry(), options);
  generate_mesh(paper_geometry(), {.size = 0.1, .tip_size = 0.001});
  EXPECT_EQ(generate_mesh(busy_geometry(), options).nodes, one.nodes);
}

TEST(GenerateMesh, AHundredThousandTrianglesTakeSeconds) {
  // Processor time, so that other programs do not count.
  const auto seconds_since = [](std::clock_t start) {
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  const std::clock_t start = std::clock();
  const Mesh mesh = generate_mesh(paper_geometry(), {.size = 0.0096, .fracture_size = 0.005});
  EXPECT_LT(seconds_since(start), 8);
  EXPECT_GT(mesh.cell_count(), 95000);
  const RawMesh raw = to_raw_mesh(mesh);
  const std::clock_t building = std::clock();
  build_mesh(raw);
  EXPECT_LT(seconds_since(building), 0.5);
}

TEST(StructuredMesh, AlternatesDiagonals) {
  const Mesh mesh = generate_mesh(box(0, 4, 0, 2), {.kind = Kind::structured, .cells = {8, 4}});
  expect_consistent(mesh);
  EXPECT_EQ(mesh.cell_count(), 64);
  EXPECT_EQ(mesh.node_count(), 45);
  for (const double area : mesh.cell_measure) EXPECT_NEAR(area, 0.125, 1e-15);
  EXPECT_EQ(mesh_quality(mesh).cells_with_one_neighbour, 0);
  EXPECT_NEAR(mesh_quality(mesh).smallest_angle, 45 * degree, 1e-12);
}

TEST(StructuredMesh, NoCornerHasASingleCellWhateverTheNumbers) {
  for (int nx = 1; nx <= 4; ++nx) {
    for (int ny = 1; ny <= 4; ++ny) {
      const Mesh mesh = generate_mesh(box(0, 1, 0, 1), {.kind = Kind::structured, .cells = {nx, ny}});
      expect_consistent(mesh);
      EXPECT_EQ(mesh_quality(mesh).cells_with_one_neighbour, 0) << nx << " x " << ny;
      EXPECT_NEAR(total_area(mesh), 1, 1e-14);
    }
  }
}

TEST(StructuredMesh, SizeGivesTheNumberOfCells) {
  const Mesh mesh = generate_mesh(box(0, 0.3, 0, 0.6), {.kind = Kind::structured, .size = 0.1});
  EXPECT_EQ(mesh.cell_count(), 2 * 3 * 6);
}

TEST(StructuredMesh, FollowsFracturesAlongLinesAndDiagonals) {
  Geometry geometry = box(0, 2, 0, 2);
  // The first diagonal starts where diagonals fall in the usual pattern.
  geometry.fractures = {fracture("diagonal", {{0.25, 0.5}, {1, 1.25}, {1.75, 1.25}}),
                        fracture("edge", {{0, 1.5}, {0.5, 1.5}})};
  geometry.regions = {region("top half", {{0, 1}, {2, 1}, {2, 2}, {0, 2}})};
  const Mesh mesh = generate_mesh(geometry, {.kind = Kind::structured, .cells = {8, 8}});
  expect_consistent(mesh);
  EXPECT_EQ(mesh.fractures[0].cell_count, 6);
  EXPECT_NEAR(fracture_length(mesh, 0), 0.75 * std::sqrt(2.0) + 0.75, 1e-14);
  EXPECT_EQ(mesh.fractures[1].cell_count, 2);
  double upper = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) upper += mesh.cell_region[c] == 1 ? mesh.cell_measure[c] : 0;
  EXPECT_NEAR(upper, 2, 1e-13);
}

TEST(StructuredMesh, RefusesFracturesOffItsLines) {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = {fracture("skew", {{0.5, 0.5}, {1.5, 1}})};
  EXPECT_THAT(input_error([&] {
                generate_mesh(geometry, {.kind = Kind::structured, .cells = {8, 8}});
              }),
              testing::AllOf(testing::HasSubstr("scene.yaml:4:5"),
                             testing::HasSubstr("fracture 'skew' does not follow the structured mesh")));
}

TEST(DistortedMesh, KeepsBoundaryFracturesAndRegionsInPlace) {
  for (const Kind kind : {Kind::unstructured, Kind::structured}) {
    Geometry geometry = box(0, 2, 0, 2);
    geometry.fractures = {fracture("main", {{0.5, 0.5}, {1.5, 1.5}})};
    geometry.regions = {region("layer", {{0, 1.5}, {2, 1.5}, {2, 2}, {0, 2}})};
    MeshOptions options{.kind = kind, .size = 0.125};
    const Mesh straight = generate_mesh(geometry, options);
    for (const double distortion : {0.1, 0.4}) {
      options.distortion = distortion;
      const Mesh mesh = generate_mesh(geometry, options);
      expect_consistent(mesh);  // includes that all areas are positive
      EXPECT_NEAR(total_area(mesh), 4, 1e-12);
      EXPECT_EQ(mesh.cell_nodes, straight.cell_nodes);
      int moved = 0;
      for (int n = 0; n < mesh.node_count(); ++n) moved += mesh.nodes[n] != straight.nodes[n] ? 1 : 0;
      EXPECT_GT(moved, mesh.node_count() / 2);
      EXPECT_NEAR(fracture_length(mesh, 0), std::sqrt(2.0), 1e-13);
      double layer = 0;
      for (int c = 0; c < mesh.cell_count(); ++c) layer += mesh.cell_region[c] == 1 ? mesh.cell_measure[c] : 0;
      EXPECT_NEAR(layer, 1, 1e-13);
      const MeshQuality before = mesh_quality(straight), after = mesh_quality(mesh);
      EXPECT_LT(after.mean_smallest_angle, before.mean_smallest_angle);
    }
    options.seed = 2;
    EXPECT_NE(generate_mesh(geometry, options).nodes, straight.nodes);
  }
}

TEST(MeshNames, AreThoseOfTheMesh) {
  const MeshNames names = mesh_names(busy_geometry());
  const Mesh mesh = generate_mesh(busy_geometry(), {.size = 0.3});
  EXPECT_EQ(names.regions, mesh.region_names);
  EXPECT_EQ(names.sides, mesh.side_names);
  ASSERT_EQ(names.fractures.size(), mesh.fractures.size());
  for (std::size_t i = 0; i < names.fractures.size(); ++i) EXPECT_EQ(names.fractures[i], mesh.fractures[i].name);
}

}  // namespace
}  // namespace sprekk::test
