// Meshes in space: bodies with two crossing fractures and one that ends inside, against what geometry and topology say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "framework/config/input_error.hpp"
#include "framework/linear/rigid_rotations.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/outer_ridges.hpp"
#include "framework/mesh/partition.hpp"
#include "framework/mesh/ridge_distance.hpp"
#include "framework/mesh/separated_mesh.hpp"
#include "tests/space/box_mesh.hpp"

namespace sprekk {
namespace {

using test::Bodies;
using test::BoxMesh;

constexpr double rounding = 1e-12;  ///< of sums over some hundred cells of size one

/// A box of 6 × 6 × 6 with two rectangles that cross: x = 3 (y 1 to 5, z 1 to 4) and y = 3 (z 2 to 5, x 1 to 5); one
/// that ends on the first: z = 3 (x 3 to 5, y 1 to 2); one that is apart and ends inside: x = 1 (y 4 to 5, z 1 to 2).
BoxMesh crossed_box(Bodies bodies) {
  BoxMesh box({6, 6, 6}, bodies);
  box.add_fracture({"first", 0, 3, {1, 1}, {5, 4}});
  box.add_fracture({"second", 1, 3, {2, 1}, {5, 5}});
  box.add_fracture({"third", 2, 3, {3, 1}, {5, 2}});
  box.add_fracture({"apart", 0, 1, {4, 1}, {5, 2}});
  return box;
}

/// The number of edges. Two that join the same nodes, both of which lie at the tip of a fracture, differ by the cells
/// around them, which are connected through faces.
int edge_count(const Mesh& mesh) {
  std::map<std::array<int, 2>, std::set<int>> faces_at;
  for (int face = 0; face < mesh.face_count(); ++face)
    for (int k = 0; k < mesh.face_nodes[face].size(); ++k)
      faces_at[sorted(ridge_of(mesh.face_nodes[face], k))].insert(face);
  int count = 0;
  for (const auto& [nodes, faces] : faces_at) {
    std::set<int> cells;
    for (const int face : faces)
      for (const int cell : mesh.face_cells[face])
        if (cell != none) cells.insert(cell);
    while (!cells.empty()) {
      ++count;
      std::vector<int> front{*cells.begin()};
      cells.erase(cells.begin());
      while (!front.empty()) {
        const int cell = front.back();
        front.pop_back();
        for (const int face : mesh.cell_faces[cell]) {
          if (faces.count(face) == 0) continue;
          for (const int next : mesh.face_cells[face])
            if (cells.erase(next) > 0) front.push_back(next);
        }
      }
    }
  }
  return count;
}

int euler_characteristic(const Mesh& mesh) {
  return mesh.node_count() - edge_count(mesh) + mesh.face_count() - mesh.cell_count();
}

double length_of(const Mesh& mesh, Ridge::Kind kind, int fracture = none) {
  double length = 0;
  for (const Ridge& ridge : mesh.ridges)
    if (ridge.kind == kind && (fracture == none || mesh.fracture_cells[ridge.cells[0]].fracture == fracture))
      length += ridge.measure;
  return length;
}

int copies_at(const Mesh& mesh, const Point& place) {
  return static_cast<int>(
      std::ranges::count_if(mesh.nodes, [&](const Point& node) { return (node - place).norm() < 1e-9; }));
}

/// What holds on every mesh, from node positions and corners alone.
void expect_consistent(const Mesh& mesh) {
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    Point closed = Point::Zero();
    double outflow = 0;  // of the field x − centre, whose divergence is 3; right where faces are flat
    for (const int face : mesh.cell_faces[cell]) {
      const double out = mesh.face_cells[face][0] == cell ? 1 : -1;
      ASSERT_TRUE(out > 0 || mesh.face_cells[face][1] == cell);
      const Point area = out * mesh.face_measure[face] * mesh.face_normal[face];
      closed += area;
      outflow += area.dot(mesh.face_center[face] - mesh.cell_center[cell]);
      ASSERT_GT(area.dot(mesh.face_center[face] - mesh.cell_center[cell]), 0);
    }
    ASSERT_LT(closed.norm(), rounding) << cell;
    if (mesh.cell_nodes[cell].size() == 4) {
      ASSERT_NEAR(outflow, 3 * mesh.cell_measure[cell], rounding);
    }
  }
  // Every face is named by its cells and by no others, and every node knows its cells and faces.
  std::vector<int> named(mesh.face_count(), 0);
  for (const CellFaces& faces : mesh.cell_faces)
    for (const int face : faces) ++named[face];
  for (int face = 0; face < mesh.face_count(); ++face) ASSERT_EQ(named[face], mesh.face_cells[face][1] == none ? 1 : 2);
  for (int node = 0; node < mesh.node_count(); ++node) {
    std::vector<int> cells, faces;
    for (int cell = 0; cell < mesh.cell_count(); ++cell)
      if (std::ranges::count(mesh.cell_nodes[cell], node)) cells.push_back(cell);
    for (int face = 0; face < mesh.face_count(); ++face)
      if (std::ranges::count(mesh.face_nodes[face], node)) faces.push_back(face);
    ASSERT_TRUE(std::ranges::equal(mesh.node_cells[node], cells)) << node;
    ASSERT_TRUE(std::ranges::equal(mesh.node_faces[node], faces)) << node;
  }
  // Walls are the two sides of their fracture cell; neighbours along a fracture share its frame's sense.
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh.fracture_cells[i];
    ASSERT_LT((mesh.face_normal[cell.faces[0]] - cell.normal).norm(), rounding);
    ASSERT_LT((mesh.face_normal[cell.faces[1]] + cell.normal).norm(), rounding);
    ASSERT_NEAR(cell.tangents.col(0).cross(cell.tangents.col(1)).dot(cell.normal), 1, rounding);
    ASSERT_NEAR(cell.tangents.col(0).dot(cell.normal), 0, rounding);
    double around = 0;
    for (const int r : cell.ridges) {
      const Ridge& ridge = mesh.ridges[r];
      ASSERT_TRUE(std::ranges::count(ridge.cells, i));
      ASSERT_NEAR((ridge.center - cell.center).dot(cell.normal), 0, rounding);
      around += ridge.measure;
    }
    const FaceNodes& nodes = mesh.face_nodes[cell.faces[0]];
    double perimeter = 0;
    for (int k = 0; k < nodes.size(); ++k) perimeter += (mesh.nodes[nodes.after(k)] - mesh.nodes[nodes[k]]).norm();
    ASSERT_NEAR(around, perimeter, rounding);
  }
  for (const Ridge& ridge : mesh.ridges) {
    if (ridge.kind != Ridge::Kind::inside) continue;
    ASSERT_EQ(mesh.fracture_cells[ridge.cells[0]].fracture, mesh.fracture_cells[ridge.cells[1]].fracture);
    ASSERT_GT(mesh.fracture_cells[ridge.cells[0]].normal.dot(mesh.fracture_cells[ridge.cells[1]].normal), 0.9);
  }
}

void expect_crossed_box(const Mesh& mesh, const std::function<Point(double, double, double)>& place) {
  double volume = 0, boundary = 0;
  for (const double cell : mesh.cell_measure) volume += cell;
  EXPECT_NEAR(volume, 216, 216 * rounding);
  for (int face = 0; face < mesh.face_count(); ++face)
    if (mesh.face_side[face] != none) boundary += mesh.face_measure[face];
  EXPECT_NEAR(boundary, 216, 216 * rounding);
  const std::array<double, 4> areas{12, 12, 2, 1}, tips{14, 14, 5, 4};
  for (int f = 0; f < 4; ++f) {
    double area = 0;
    for (int i = 0; i < mesh.fractures[f].cell_count; ++i)
      area += mesh.fracture_cells[mesh.fractures[f].first_cell + i].measure;
    EXPECT_NEAR(area, areas[f], rounding) << f;
    EXPECT_NEAR(length_of(mesh, Ridge::Kind::tip, f), tips[f], rounding) << f;
  }
  EXPECT_EQ(length_of(mesh, Ridge::Kind::on_boundary), 0);
  // The first two cross over z 2 to 4, two edges with four cells; the third ends on the first over y 1 to 2.
  std::map<std::size_t, double> junctions;
  for (const Junction& junction : mesh.junctions) {
    const std::size_t count = junction.cells.size();
    EXPECT_EQ(junction.ridges.size(), count * (count - 1) / 2);
    junctions[count] += mesh.ridges[junction.ridges[0]].measure;
    for (const int ridge : junction.ridges) {
      EXPECT_EQ(mesh.ridges[ridge].center, mesh.ridges[junction.ridges[0]].center);
      EXPECT_EQ(mesh.ridges[ridge].kind, Ridge::Kind::junction);
    }
  }
  EXPECT_EQ(junctions.size(), 2U);
  EXPECT_NEAR(junctions[4], 2, rounding);
  EXPECT_NEAR(junctions[3], 1, rounding);
  // Four parts of rock meet inside of the crossing; where the first ends on the second, and the other way round, two.
  EXPECT_EQ(copies_at(mesh, place(3, 3, 3)), 4);
  EXPECT_EQ(copies_at(mesh, place(3, 3, 2)), 2);
  EXPECT_EQ(copies_at(mesh, place(3, 3, 4)), 2);
  EXPECT_EQ(copies_at(mesh, place(3, 2, 3)), 2);  // the corner of the third, on the first
  EXPECT_EQ(copies_at(mesh, place(3, 1, 3)), 1);  // its other one, at the tip of the first
  EXPECT_EQ(copies_at(mesh, place(3, 4, 3)), 2);
  EXPECT_EQ(copies_at(mesh, place(5, 3, 3)), 1);
  EXPECT_EQ(copies_at(mesh, place(0, 0, 0)), 1);
  // A ball with two cavities: around the fractures that meet, and around the one that is apart.
  EXPECT_EQ(euler_characteristic(mesh), 3);
}

class Space : public testing::TestWithParam<Bodies> {};
INSTANTIATE_TEST_SUITE_P(Bodies, Space,
                         testing::Values(Bodies::hexahedra, Bodies::wedges, Bodies::tetrahedra,
                                         Bodies::hexahedra_and_wedges));

TEST_P(Space, FracturesSplitABox) {
  const Mesh mesh = build_mesh(crossed_box(GetParam()).raw);
  expect_consistent(mesh);
  expect_crossed_box(mesh, [](double x, double y, double z) { return Point(x, y, z); });
  // The normal of the first fracture is that of the faces it was given, and its strike is horizontal.
  for (const FractureCell& cell : mesh.fracture_cells) EXPECT_NEAR(cell.tangents(2, 0), 0, rounding);
}

TEST_P(Space, RidgesAreAsFarAsTheirHeightsSay) {
  // From the centre of gravity half of the way across a quadrilateral, a third of the height of a triangle: its area
  // over the length of the edge, and 2/3 of that.
  BoxMesh box = crossed_box(GetParam());
  box.turn(Eigen::AngleAxisd(0.7, Point(1, 2, 3).normalized()));
  const Mesh mesh = build_mesh(box.raw);
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh.fracture_cells[i];
    const double share = cell.ridges.size() == 3 ? 2.0 / 3 : 0.5;
    for (const int ridge : cell.ridges)
      EXPECT_NEAR(distance_to_ridge(mesh, i, ridge), share * cell.measure / mesh.ridges[ridge].measure, rounding);
  }
}

TEST_P(Space, TurnedAndDistorted) {
  BoxMesh box = crossed_box(GetParam());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> by(-0.1, 0.1);
  box.move_free_nodes([&] { return Point(by(random), by(random), by(random)); });
  const Eigen::AngleAxisd rotation(0.7, Point(1, 2, 3).normalized());
  box.turn(rotation);
  const Mesh mesh = build_mesh(box.raw);
  expect_consistent(mesh);
  expect_crossed_box(mesh, [&](double x, double y, double z) { return Point(rotation * Point(x, y, z)); });
}

TEST_P(Space, MirroredCellsAndTurnedFacesAreTheSameMesh) {
  const BoxMesh box = crossed_box(GetParam());
  RawMesh raw = box.raw;
  std::mt19937 random(11);
  for (CellNodes& cell : raw.cells) {
    if (random() % 2 == 0) continue;
    if (cell.size() == 4)
      std::swap(cell[2], cell[3]);
    else
      std::rotate(cell.begin(), cell.begin() + cell.size() / 2, cell.end());
  }
  for (auto& fracture : raw.fractures)
    for (std::size_t i = 1; i < fracture.faces.size(); ++i) {
      FaceNodes& face = fracture.faces[i];
      std::rotate(face.begin(), face.begin() + static_cast<int>(random() % face.size()), face.end());
      if (random() % 2 == 0) face = reversed(face);
    }
  const Mesh mesh = build_mesh(raw), plain = build_mesh(box.raw);
  expect_consistent(mesh);
  expect_crossed_box(mesh, [](double x, double y, double z) { return Point(x, y, z); });
  for (int i = 0; i < mesh.fracture_cell_count(); ++i)
    EXPECT_LT((mesh.fracture_cells[i].normal - plain.fracture_cells[i].normal).norm(), rounding);
}

TEST_P(Space, AFractureReachesTheSides) {
  // One that divides the box, and one that crosses it and reaches a side.
  BoxMesh box({4, 4, 4}, GetParam());
  box.add_fracture({"whole", 0, 2, {0, 0}, {4, 4}});
  box.add_fracture({"half", 1, 2, {1, 0}, {4, 3}});
  const Mesh mesh = build_mesh(box.raw);
  expect_consistent(mesh);
  // Two balls.
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_NEAR(length_of(mesh, Ridge::Kind::on_boundary, 0), 16, rounding);
  EXPECT_EQ(length_of(mesh, Ridge::Kind::tip, 0), 0);
  // Its ridges on the boundary: at the left over z 1 to 4, at the top over x 0 to 3.
  std::map<std::string, double> on_side;
  for (const Ridge& ridge : mesh.ridges)
    if (ridge.kind == Ridge::Kind::on_boundary && mesh.fracture_cells[ridge.cells[0]].fracture == 1)
      on_side[mesh.side_names[ridge.side]] += ridge.measure;
  EXPECT_EQ(on_side.size(), 2U);
  EXPECT_NEAR(on_side["left"], 3, rounding);
  EXPECT_NEAR(on_side["top"], 3, rounding);
  EXPECT_NEAR(length_of(mesh, Ridge::Kind::tip, 1), 6, rounding);
  EXPECT_EQ(copies_at(mesh, Point(2, 2, 4)), 4);
  EXPECT_EQ(copies_at(mesh, Point(2, 2, 0)), 2);
}

TEST_P(Space, ThreePlanesThroughOnePoint) {
  BoxMesh box({4, 4, 4}, GetParam());
  for (int axis = 0; axis < 3; ++axis) box.add_fracture({std::string(1, "xyz"[axis]), axis, 2, {1, 1}, {3, 3}});
  const Mesh mesh = build_mesh(box.raw);
  expect_consistent(mesh);
  EXPECT_EQ(copies_at(mesh, Point(2, 2, 2)), 8);
  EXPECT_EQ(mesh.junctions.size(), 6U);
  for (const Junction& junction : mesh.junctions) EXPECT_EQ(junction.cells.size(), 4U);
  EXPECT_EQ(euler_characteristic(mesh), 2);
}

TEST_P(Space, TheClosedMeshIsTheOneThatWasGiven) {
  const Mesh mesh = build_mesh(crossed_box(GetParam()).raw);
  const Mesh again = build_mesh(to_raw_mesh(mesh));
  EXPECT_EQ(again.nodes, mesh.nodes);
  EXPECT_EQ(again.cell_nodes, mesh.cell_nodes);
  EXPECT_EQ(again.face_nodes, mesh.face_nodes);
  ASSERT_EQ(again.ridges.size(), mesh.ridges.size());
  for (std::size_t i = 0; i < mesh.ridges.size(); ++i) EXPECT_EQ(again.ridges[i].cells, mesh.ridges[i].cells);
}

TEST_P(Space, PartsAreEqualAndCompact) {
  Mesh mesh = build_mesh(crossed_box(GetParam()).raw);
  partition(mesh, 5);
  for (int rank = 0; rank < 5; ++rank)
    EXPECT_NEAR(static_cast<double>(std::ranges::count(mesh.cell_rank, rank)), mesh.cell_count() / 5.0, 1);
}

TEST_P(Space, ARegionIsCutOut) {
  const Mesh mesh = build_mesh(crossed_box(GetParam()).raw);
  std::vector<char> inside(mesh.cell_count(), 0);
  for (int cell = 0; cell < mesh.cell_count(); ++cell) inside[cell] = mesh.cell_center[cell].norm() < 4;
  const Mesh cut = separated_mesh(mesh, inside);
  expect_consistent(cut);
  for (const auto& [one, other] : cut.face_cells) EXPECT_TRUE(other == none || inside[one] == inside[other]);
}

/// The message of the refusal.
std::string refusal(const RawMesh& raw) {
  try {
    build_mesh(raw);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SpaceRefused, WhatIsNoMesh) {
  const RawMesh good = BoxMesh({2, 2, 2}, Bodies::hexahedra).raw;
  EXPECT_EQ(refusal(good), "");
  RawMesh raw = good;
  raw.cells[0] = {0, 1, 4, 3, 9};
  EXPECT_NE(refusal(raw).find("divide pyramids into tetrahedra"), std::string::npos) << refusal(raw);
  raw = good;
  std::swap(raw.cells[0][0], raw.cells[0][1]);
  EXPECT_NE(refusal(raw).find("is not convex"), std::string::npos) << refusal(raw);
  raw = good;
  raw.nodes[13] = Point(1.9, 1.9, -0.5);  // the middle
  EXPECT_NE(refusal(raw).find("is not convex"), std::string::npos) << refusal(raw);
  raw = good;
  raw.boundary_faces.pop_back();
  EXPECT_NE(refusal(raw).find("belongs to no side"), std::string::npos) << refusal(raw);
  raw = good;
  raw.cells.push_back(raw.cells[0]);
  raw.regions.push_back(0);
  EXPECT_NE(refusal(raw).find("two cells lie on the same side"), std::string::npos) << refusal(raw);
  raw = good;
  raw.cells[0][6] = 99;
  EXPECT_NE(refusal(raw).find("does not exist"), std::string::npos) << refusal(raw);
}

TEST(SpaceRefused, FracturesThatAreNone) {
  const auto with = [](const std::vector<test::GridRectangle>& fractures) {
    BoxMesh box({4, 4, 4}, Bodies::tetrahedra);
    for (const auto& fracture : fractures) box.add_fracture(fracture);
    return box.raw;
  };
  EXPECT_EQ(refusal(with({{"a", 0, 2, {1, 1}, {3, 3}}})), "");
  EXPECT_NE(refusal(with({{"a", 0, 2, {1, 1}, {3, 3}}, {"b", 0, 2, {2, 2}, {4, 4}}})).find("run along the same face"),
            std::string::npos);
  EXPECT_NE(refusal(with({{"a", 0, 0, {1, 1}, {3, 3}}})).find("the outer boundary"), std::string::npos);
  EXPECT_NE(refusal(with({{"a", 0, 2, {1, 1}, {1, 3}}})).find("has no face"), std::string::npos);
  // Three faces of one fracture at an edge.
  RawMesh raw = with({{"a", 0, 2, {1, 1}, {3, 3}}, {"b", 1, 2, {1, 2}, {3, 3}}});
  raw.fractures[0].faces.insert(raw.fractures[0].faces.end(), raw.fractures[1].faces.begin(),
                                raw.fractures[1].faces.end());
  raw.fractures.pop_back();
  EXPECT_NE(refusal(raw).find("'a' meets itself"), std::string::npos) << refusal(raw);
  raw = with({{"a", 0, 2, {1, 1}, {3, 3}}});
  raw.fractures[0].faces[0] = {0, 30, 60};
  EXPECT_NE(refusal(raw).find("leaves the faces of the mesh"), std::string::npos) << refusal(raw);
}

TEST(SpaceGeometry, AWarpedFaceHasTheAreaVectorOfItsEdges) {
  // Half of the sum of the cross products of its corners, whichever surface the edges bound.
  const std::vector<Point> nodes{{0, 0, 0}, {2, 0.1, 0.3}, {2.2, 1, -0.2}, {-0.1, 1.3, 0.4}};
  Point area = Point::Zero();
  for (int k = 0; k < 4; ++k) area += 0.5 * nodes[k].cross(nodes[(k + 1) % 4]);
  const FaceGeometry face = face_geometry(nodes, {0, 1, 2, 3});
  EXPECT_LT((face.measure * face.normal - area).norm(), 1e-15);
}

TEST(SpaceGeometry, VolumesAndCentresOfTheShapes) {
  // A frustum: the unit square below, a square of half its edge above. Volume h (A + a + sqrt(A a))/3; the centre is at
  // h (A + 2 sqrt(A a) + 3 a) / (4 (A + sqrt(A a) + a)) above the bottom.
  const std::vector<Point> frustum{{0, 0, 0},       {1, 0, 0},       {1, 1, 0},       {0, 1, 0},
                                   {0.25, 0.25, 2}, {0.75, 0.25, 2}, {0.75, 0.75, 2}, {0.25, 0.75, 2}};
  const Measured body = cell_geometry(frustum, {0, 1, 2, 3, 4, 5, 6, 7});
  EXPECT_NEAR(body.measure, 2 * (1 + 0.25 + 0.5) / 3, 1e-15);
  EXPECT_LT((body.center - Point(0.5, 0.5, 2 * (1 + 1 + 0.75) / (4 * 1.75))).norm(), 1e-15);
  const Measured wedge =
      cell_geometry({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 3}, {1, 0, 3}, {0, 1, 3}}, {0, 1, 2, 3, 4, 5});
  EXPECT_NEAR(wedge.measure, 1.5, 1e-15);
  EXPECT_LT((wedge.center - Point(1.0 / 3, 1.0 / 3, 1.5)).norm(), 1e-15);
  const Measured tetrahedron = cell_geometry({{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}}, {0, 1, 2, 3});
  EXPECT_NEAR(tetrahedron.measure, 1.0 / 6, 1e-15);
  EXPECT_LT((tetrahedron.center - Point(1.25, 1.25, 1.25)).norm(), 1e-15);
}

static_assert(dimension == 3 && symmetric_components == 6 && rigid_rotations(dimension) == 3);

Point random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  Point point;
  for (double& value : point) value = number(random);
  return point;
}

TEST(SpaceFrames, RotationsDoNotStrainAndSpanThoseOfEveryAxis) {
  std::mt19937 random(18);
  const Point axis = random_point(random);
  // Coefficients of the three rotations for w × x: of (x, y) the turn about z, of (x, z) against that about y.
  const Point coefficients(axis[2], -axis[1], axis[0]);
  for (int k = 0; k < 20; ++k) {
    const Point a = random_point(random), b = random_point(random);
    EXPECT_NEAR((rotated(a) * coefficients - axis.cross(a)).norm(), 0, 1e-15);
    // The distance between two points does not change.
    EXPECT_NEAR(((rotated(a) - rotated(b)).transpose() * (a - b)).norm(), 0, 1e-15);
  }
}

TEST(SpaceFrames, AFractureCellTakesVectorsIntoItsFrameAndBack) {
  std::mt19937 random(18);
  FractureCell cell{};
  cell.normal = random_point(random).normalized();
  cell.tangents.col(0) = cell.normal.unitOrthogonal();
  cell.tangents.col(1) = cell.normal.cross(cell.tangents.col(0));
  EXPECT_NEAR((cell.to_local(cell.normal) - Point(1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((cell.to_local(cell.tangents.col(1)) - Point(0, 0, 1)).norm(), 0, 1e-15);
  for (int k = 0; k < 20; ++k) {
    const Point vector = random_point(random);
    EXPECT_NEAR((cell.to_global(cell.to_local(vector)) - vector).norm(), 0, 1e-15);
    EXPECT_NEAR(cell.to_local(vector).norm(), vector.norm(), 1e-15);
  }
}

}  // namespace
}  // namespace sprekk
