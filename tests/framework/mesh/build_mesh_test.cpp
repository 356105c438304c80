#include "framework/mesh/build_mesh.hpp"

#include <algorithm>

#include "framework/mesh/face_table.hpp"
#include "framework/meshing/fracture_networks.hpp"
#include "framework/meshing/structured_mesh.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Kind = Ridge::Kind;

/// The box [0, 8] x [0, 8] in unit squares, with fractures along its lines.
RawMesh squares(const std::vector<FractureGeometry>& fractures) {
  Geometry geometry = box(0, 8, 0, 8);
  geometry.fractures = fractures;
  MeshOptions options;
  options.kind = MeshOptions::Kind::structured;
  options.cells = {8, 8};
  return structured_mesh(geometry, options);
}

constexpr int unsplit_nodes = 81, unsplit_faces = 8 * 9 * 2 + 64;

TEST(BuildMesh, IsConsistentWithoutFractures) {
  const Mesh mesh = build_mesh(squares({}));
  expect_consistent(mesh);
  EXPECT_EQ(mesh.node_count(), unsplit_nodes);
  EXPECT_EQ(mesh.face_count(), unsplit_faces);
  EXPECT_EQ(mesh.cell_count(), 128);
  EXPECT_EQ(euler_characteristic(mesh), 1);
  EXPECT_NEAR(total_area(mesh), 64, 1e-12);
  EXPECT_TRUE(mesh.fractures.empty());
}

TEST(BuildMesh, SplitsInnerFractureBetweenItsTips) {
  const Mesh mesh = build_mesh(squares({fracture("main", {{2, 4}, {6, 4}})}));
  expect_consistent(mesh);
  EXPECT_EQ(mesh.fracture_cell_count(), 4);
  EXPECT_EQ(mesh.node_count(), unsplit_nodes + 3);  // the two tips exist once
  EXPECT_EQ(mesh.face_count(), unsplit_faces + 4);
  EXPECT_EQ(euler_characteristic(mesh), 0);  // a disc with a hole
  EXPECT_EQ(component_count(mesh), 1);
  EXPECT_EQ(mesh.ridges.front().kind, Kind::tip);
  EXPECT_EQ(mesh.ridges[1].kind, Kind::inside);
  EXPECT_EQ(mesh.ridges.back().kind, Kind::tip);
  // Along +x the plus side is above, and the normal points down.
  EXPECT_EQ(mesh.fracture_cells[0].normal, Point(0, -1));
  EXPECT_GT(mesh.cell_center[mesh.face_cells[mesh.fracture_cells[0].faces[0]][0]].y(), 4);
  EXPECT_LT(mesh.cell_center[mesh.face_cells[mesh.fracture_cells[0].faces[1]][0]].y(), 4);
}

TEST(BuildMesh, FractureOfOneCellHasNoNodeToSplit) {
  const Mesh mesh = build_mesh(squares({fracture("short", {{2, 4}, {3, 4}})}));
  expect_consistent(mesh);
  EXPECT_EQ(mesh.node_count(), unsplit_nodes);
  EXPECT_EQ(mesh.face_count(), unsplit_faces + 1);
  EXPECT_EQ(euler_characteristic(mesh), 0);
}

TEST(BuildMesh, SplitsEndOnBoundary) {
  const Mesh mesh = build_mesh(squares({fracture("edge", {{4, 4}, {8, 4}})}));
  expect_consistent(mesh);
  EXPECT_EQ(mesh.node_count(), unsplit_nodes + 4);
  EXPECT_EQ(euler_characteristic(mesh), 1);
  EXPECT_EQ(mesh.ridges.front().kind, Kind::tip);
  const Ridge& end = mesh.ridges.back();
  EXPECT_EQ(end.kind, Kind::on_boundary);
  EXPECT_EQ(mesh.side_names[end.side], "right");
}

TEST(BuildMesh, FractureThroughTheBoxSeparatesIt) {
  const Mesh mesh = build_mesh(squares({fracture("through", {{0, 2}, {8, 2}})}));
  expect_consistent(mesh);
  EXPECT_EQ(mesh.node_count(), unsplit_nodes + 9);
  EXPECT_EQ(component_count(mesh), 2);
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_NEAR(total_area(mesh), 64, 1e-12);
}

TEST(BuildMesh, TwoFracturesAndOneWithKinks) {
  const Mesh mesh =
      build_mesh(squares({fracture("kinked", {{2, 2}, {4, 2}, {4, 4}, {5, 5}}), fracture("other", {{7, 6}, {1, 6}})}));
  expect_consistent(mesh);
  EXPECT_EQ(mesh.fractures[0].cell_count, 5);
  EXPECT_EQ(mesh.fractures[1].first_cell, 5);
  EXPECT_EQ(mesh.fractures[1].cell_count, 6);
  EXPECT_EQ(mesh.node_count(), unsplit_nodes + 4 + 5);
  EXPECT_EQ(euler_characteristic(mesh), -1);  // two holes
  EXPECT_NEAR(fracture_length(mesh, 0), 4 + std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(fracture_length(mesh, 1), 6, 1e-14);
  EXPECT_EQ(mesh.fracture_cells[2].tangents, Point(0, 1));
  EXPECT_EQ(mesh.fracture_cells[2].normal, Point(1, 0));
  EXPECT_EQ(mesh.fracture_cells[5].normal, Point(0, 1));  // runs along -x: plus is below
}

TEST(BuildMesh, SplitNodesKeepTheirPlaceAndCopiesComeLast) {
  const RawMesh raw = squares({fracture("main", {{2, 4}, {6, 4}})});
  const Mesh mesh = build_mesh(raw);
  for (int n = 0; n < unsplit_nodes; ++n) EXPECT_EQ(mesh.nodes[n], raw.nodes[n]);
  for (int n = unsplit_nodes; n < mesh.node_count(); ++n) EXPECT_EQ(mesh.nodes[n].y(), 4);
}

TEST(BuildMesh, TurnsClockwiseTrianglesAndDropsUnusedNodes) {
  RawMesh raw = squares({});
  const Mesh straight = build_mesh(raw);
  for (Ring& cell : raw.cells) cell.turn();
  raw.nodes.emplace_back(100, 100);
  const Mesh turned = build_mesh(raw);
  expect_consistent(turned);
  EXPECT_EQ(turned.node_count(), unsplit_nodes);
  EXPECT_EQ(turned.cell_measure, straight.cell_measure);
}

TEST(BuildMesh, VersionsAreUnique) {
  const RawMesh raw = squares({});
  EXPECT_NE(build_mesh(raw).version, build_mesh(raw).version);
}

TEST(BuildMesh, RawMeshClosesTheWallsAgain) {
  const RawMesh raw = squares({fracture("kinked", {{2, 2}, {4, 2}, {4, 4}}), fracture("edge", {{5, 6}, {8, 6}})});
  const Mesh mesh = build_mesh(raw);
  std::vector<int> merged;
  const RawMesh closed = to_raw_mesh(mesh, &merged);
  EXPECT_EQ(closed.nodes, raw.nodes);
  EXPECT_EQ(closed.cells, raw.cells);
  EXPECT_EQ(closed.fractures[0].nodes, raw.fractures[0].nodes);
  EXPECT_EQ(closed.fractures[1].nodes, raw.fractures[1].nodes);
  EXPECT_EQ(closed.boundary_faces.size(), raw.boundary_faces.size());
  for (int n = 0; n < mesh.node_count(); ++n) EXPECT_EQ(raw.nodes[merged[n]], mesh.nodes[n]);
  const Mesh again = build_mesh(closed);
  EXPECT_EQ(again.cell_nodes, mesh.cell_nodes);
  EXPECT_EQ(again.face_side, mesh.face_side);
}

int junction_points(const Mesh& mesh) {
  int count = 0;
  for (const Ridge& point : mesh.ridges) count += point.kind == Kind::junction;
  return count;
}

TEST(BuildMesh, SplitsACrossingIntoFour) {
  const Mesh mesh = build_mesh(squares({fracture("a", {{2, 4}, {6, 4}}), fracture("b", {{4, 2}, {4, 6}})}));
  expect_consistent(mesh);
  EXPECT_EQ(mesh.node_count(), unsplit_nodes + 4 + 3);
  EXPECT_EQ(mesh.face_count(), unsplit_faces + 8);
  EXPECT_EQ(euler_characteristic(mesh), 0);  // one hole in the shape of a cross
  ASSERT_EQ(mesh.junctions.size(), 1u);
  EXPECT_EQ(mesh.junctions[0].cells, (std::vector{1, 2, 5, 6}));
  EXPECT_EQ(mesh.junctions[0].ridges.size(), 6u);  // pairs of four
  EXPECT_EQ(junction_points(mesh), 6);
  EXPECT_EQ(mesh.ridges.size(), 2 * 4u + 6u);
  // Between neighbours in a fracture lies their own point.
  EXPECT_EQ(mesh.fracture_cells[1].ridges[1], mesh.fracture_cells[2].ridges[0]);
  EXPECT_EQ(mesh.ridges[mesh.fracture_cells[6].ridges[0]].cells, (std::vector{5, 6}));
}

TEST(BuildMesh, FracturesThatCrossFromSideToSidePartTheRock) {
  const Mesh mesh = build_mesh(squares({fracture("a", {{0, 4}, {8, 4}}), fracture("b", {{4, 0}, {4, 8}})}));
  expect_consistent(mesh);
  EXPECT_EQ(component_count(mesh), 4);
  EXPECT_EQ(euler_characteristic(mesh), 4);
}

TEST(BuildMesh, AFractureMayEndAtAnother) {
  const Mesh mesh = build_mesh(squares({fracture("b", {{4, 4}, {4, 6}}), fracture("a", {{2, 4}, {6, 4}})}));
  expect_consistent(mesh);
  EXPECT_EQ(mesh.node_count(), unsplit_nodes + 3 + 2);
  ASSERT_EQ(mesh.junctions.size(), 1u);
  EXPECT_EQ(mesh.junctions[0].cells, (std::vector{0, 3, 4}));
  EXPECT_EQ(junction_points(mesh), 3);
  const Ridge& end = mesh.ridges[mesh.fracture_cells[0].ridges[0]];
  EXPECT_EQ(end.kind, Kind::junction);
  EXPECT_EQ(end.center, Point(4, 4));
  EXPECT_EQ(end.cells, (std::vector{0, 3}));
  EXPECT_EQ(
      std::count_if(mesh.ridges.begin(), mesh.ridges.end(), [](const Ridge& point) { return point.kind == Kind::tip; }),
      3);
}

TEST(BuildMesh, FracturesEndToEndAreSplitLikeOne) {
  const Mesh mesh = build_mesh(squares({fracture("a", {{2, 4}, {4, 4}}), fracture("b", {{4, 4}, {6, 4}})}));
  expect_consistent(mesh);
  EXPECT_EQ(mesh.node_count(), unsplit_nodes + 3);
  ASSERT_EQ(mesh.junctions.size(), 1u);
  EXPECT_EQ(mesh.junctions[0].ridges.size(), 1u);
  EXPECT_EQ(mesh.fracture_cells[1].ridges[1], mesh.fracture_cells[2].ridges[0]);
}

TEST(BuildMesh, AFractureOfOneCellMayJoinTwo) {
  const Mesh mesh = build_mesh(
      squares({fracture("a", {{2, 4}, {6, 4}}), fracture("b", {{2, 5}, {6, 5}}), fracture("c", {{4, 5}, {4, 4}})}));
  expect_consistent(mesh);
  ASSERT_EQ(mesh.junctions.size(), 2u);
  EXPECT_EQ(mesh.ridges[mesh.fracture_cells[8].ridges[0]].center, Point(4, 5));
  EXPECT_EQ(mesh.ridges[mesh.fracture_cells[8].ridges[1]].center, Point(4, 4));
  EXPECT_EQ(fracture_networks(mesh), (std::vector{0, 0, 0}));
}

TEST(FractureNetworks, AreWhatJunctionsConnect) {
  const Mesh mesh = build_mesh(squares({fracture("a", {{1, 1}, {2, 1}}), fracture("b", {{2, 4}, {6, 4}}),
                                        fracture("c", {{4, 4}, {4, 6}}), fracture("d", {{1, 7}, {2, 7}})}));
  EXPECT_EQ(fracture_networks(mesh), (std::vector{0, 1, 1, 3}));
  EXPECT_EQ(fracture_networks(mesh, {{3, 2}}), (std::vector{0, 1, 1, 1}));
  EXPECT_EQ(fracture_networks(mesh, {{3, 2}, {0, 3}}), (std::vector{0, 0, 0, 0}));
}

TEST(BuildMesh, RefusesFracturesThatOverlap) {
  EXPECT_THAT(input_error([] {
                build_mesh(squares({fracture("a", {{2, 4}, {6, 4}}), fracture("b", {{5, 4}, {7, 4}})}));
              }),
              AllOf(HasSubstr("'a' and 'b' run along the same edge"), HasSubstr("(5.5, 4)"), HasSubstr("not overlap")));
}

TEST(BuildMesh, RefusesFracturesThatMeetOnTheBoundary) {
  RawMesh raw = squares({fracture("a", {{0, 4}, {6, 4}})});
  const int on_side = raw.fractures[0].nodes[0], above = on_side + 9 + 1, below = on_side - 9 + 1;
  const FaceTable edges(raw.nodes, raw.cells);
  raw.fractures.push_back({"b", {on_side, edges.find({on_side, above}) == none ? below : above}});
  EXPECT_THAT(input_error([&] { build_mesh(raw); }),
              AllOf(HasSubstr("'a' and 'b' meet at (0, 4)"), HasSubstr("on the outer boundary")));
}

TEST(BuildMesh, RefusesFracturesThatAreNoPaths) {
  RawMesh raw = squares({fracture("loop", {{2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 3}})});
  raw.fractures[0].nodes.push_back(raw.fractures[0].nodes[0]);
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("fracture 'loop' meets itself at (2, 2)"));
  raw = squares({});
  raw.fractures = {{"jump", {0, 80}}};
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("fracture 'jump' leaves the edges of the mesh"));
  raw.fractures = {{"empty", {40}}};
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("fracture 'empty' has no edge"));
  raw.fractures = {{"outside", {0, 1}}};
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("runs along the outer boundary"));
  raw.fractures = {{"touching", {20, 10, 1, 2}}};
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("fracture 'touching' touches the outer boundary"));
}

TEST(BuildMesh, RefusesWrongTriangles) {
  const RawMesh good{.nodes = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}},
                     .cells = {{0, 1, 2}, {1, 3, 2}},
                     .regions = {0, 0},
                     .region_names = {"rock"},
                     .boundary_faces = {{{0, 1}, 0}, {{1, 3}, 0}, {{3, 2}, 0}, {{2, 0}, 0}},
                     .side_names = {"outside"},
                     .fractures = {}};
  expect_consistent(build_mesh(good));

  RawMesh raw = good;
  raw.nodes[3] = {0.5, 0.5};
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("is degenerate"));
  raw = good;
  raw.cells.push_back({1, 4, 2});
  raw.regions.push_back(0);
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("more than two cells meet"));
  raw = good;
  raw.nodes[3] = {0.1, 0.1};
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("two cells lie on the same side"));
  raw = good;
  raw.cells[1][1] = 7;
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("a node that does not exist"));
  raw = good;
  raw.boundary_faces.pop_back();
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("the outer edge at (0, 0.5) belongs to no side"));
  raw = good;
  raw.boundary_faces.push_back({{1, 2}, 0});
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("has an edge inside the mesh"));
  raw = good;
  raw.side_names.push_back("second");
  raw.boundary_faces.push_back({{0, 1}, 1});
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("belongs to two sides ('outside' and 'second')"));
  raw = good;
  raw.regions.pop_back();
  EXPECT_THROW(build_mesh(raw), std::logic_error);
}

TEST(BuildMesh, RefusesTrianglesThatMeetInOneNode) {
  const RawMesh raw{.nodes = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}},
                    .cells = {{0, 1, 2}, {0, 3, 4}},
                    .regions = {0, 0},
                    .region_names = {"rock"},
                    .boundary_faces = {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 0}, 0}, {{0, 3}, 0}, {{3, 4}, 0}, {{4, 0}, 0}},
                    .side_names = {"outside"},
                    .fractures = {}};
  EXPECT_THAT(input_error([&] { build_mesh(raw); }), HasSubstr("touches itself at (0, 0)"));
}

TEST(FaceTable, FindsEdgesInEitherDirection) {
  const std::vector<Point> nodes{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  const FaceTable edges(nodes, {{0, 1, 2}, {1, 3, 2}});
  EXPECT_EQ(edges.size(), 5);
  const int diagonal = edges.find({2, 1});
  EXPECT_EQ(diagonal, edges.find({1, 2}));
  EXPECT_EQ(edges.nodes(diagonal), (std::array{1, 2}));
  EXPECT_EQ(edges.cells(diagonal), (std::array{0, 1}));
  EXPECT_FALSE(edges.is_outer(diagonal));
  EXPECT_EQ(edges.find({0, 3}), none);
  EXPECT_EQ(edges.find({0, 9}), none);
}

}  // namespace
}  // namespace sprekk::test
