// Meshes of boxes in space: structured ones and tetrahedra by gmsh, against what geometry and topology say.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "framework/mesh/outer_ridges.hpp"
#include "framework/mesh/quality/mesh_quality.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "framework/meshing/space/flat_shape.hpp"
#include "framework/meshing/space/strike_and_dip.hpp"
#include "tests/space/meshing/measures.hpp"

namespace sprekk {
namespace {

using std::numbers::pi;
using test::area_of;
using test::volume_of;
using testing::AllOf;
using testing::HasSubstr;
using Shape = MeshOptions::Shape;
using Kind = MeshOptions::Kind;

constexpr double round_off = 1e-10;

Geometry box(const Point& low, const Point& high) {
  Geometry geometry;
  geometry.box = {low, high, {"scene.yaml", 2}};
  return geometry;
}

FractureGeometry polygon(const std::string& name, const std::vector<Point>& points) {
  return {name, points, std::nullopt, {"scene.yaml", 5}};
}

FractureGeometry disc(const std::string& name, const Ellipse& ellipse) {
  FractureGeometry fracture = polygon(name, {});
  fracture.ellipse = ellipse;
  return fracture;
}

double length_of(const Mesh& mesh, Ridge::Kind kind) {
  double length = 0;
  for (const Ridge& ridge : mesh.ridges)
    if (ridge.kind == kind) length += ridge.measure;
  return length;
}

double junction_length(const Mesh& mesh) {
  double length = 0;
  for (const Junction& junction : mesh.junctions) length += mesh.ridges[junction.ridges[0]].measure;
  return length;
}

/// What holds for a mesh that fills a box.
void expect_fills(const Box& box, const Mesh& mesh) {
  double volume = 0;
  for (const double measure : mesh.cell_measure) volume += measure;
  EXPECT_NEAR(volume, box.size().prod(), round_off * box.size().prod());
  std::vector<double> areas(6, 0);
  for (int face = 0; face < mesh.face_count(); ++face) {
    const int side = mesh.face_side[face];
    if (side == none) continue;
    areas[side] += mesh.face_measure[face];
    const int axis = side / 2;
    for (const int node : mesh.face_nodes[face])
      ASSERT_EQ(mesh.nodes[node][axis], (side % 2 == 0 ? box.low : box.high)[axis]);
    ASSERT_NEAR(mesh.face_normal[face][axis], side % 2 == 0 ? -1 : 1, round_off);
  }
  EXPECT_EQ(mesh.side_names, (std::vector<std::string>{"left", "right", "front", "back", "bottom", "top"}));
  for (int side = 0; side < 6; ++side) {
    const double area = box.size().prod() / box.size()[side / 2];
    EXPECT_NEAR(areas[side], area, round_off * area) << side;
  }
}

/// Nodes less edges and so on of a mesh without fractures: one for a ball.
int euler_characteristic(const Mesh& mesh) {
  std::set<RidgeNodes> edges;
  for (const FaceNodes& face : mesh.face_nodes)
    for (int k = 0; k < face.size(); ++k) edges.insert(sorted(ridge_of(face, k)));
  return mesh.node_count() - static_cast<int>(edges.size()) + mesh.face_count() - mesh.cell_count();
}

std::string refusal(const Geometry& geometry, const MeshOptions& options = {}) {
  try {
    generate_mesh(geometry, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class StructuredInSpace : public testing::TestWithParam<Shape> {
 protected:
  MeshOptions options(const std::array<int, 3>& cells) const {
    return {.kind = Kind::structured, .shape = GetParam(), .cells = cells};
  }
};
INSTANTIATE_TEST_SUITE_P(Shapes, StructuredInSpace,
                         testing::Values(Shape::hexahedra, Shape::wedges, Shape::tetrahedra));

TEST_P(StructuredInSpace, FillsTheBox) {
  const Geometry geometry = box({-1, 0, 2}, {2, 1, 4});
  const Mesh mesh = generate_mesh(geometry, options({3, 4, 5}));
  const int each = GetParam() == Shape::hexahedra ? 1 : GetParam() == Shape::wedges ? 2 : 6;
  EXPECT_EQ(mesh.cell_count(), each * 60);
  EXPECT_EQ(mesh.node_count(), 4 * 5 * 6);
  expect_fills(geometry.box, mesh);
  EXPECT_EQ(euler_characteristic(mesh), 1);
}

TEST_P(StructuredInSpace, FollowsFacesOfTheGrid) {
  Geometry geometry = box({0, 0, 0}, {4, 4, 4});
  // An L in the plane x = 2, and a rectangle in y = 2 that crosses it and ends on the left side.
  geometry.fractures = {
      polygon("ell", {{2, 1, 1}, {2, 3, 1}, {2, 3, 2}, {2, 2, 2}, {2, 2, 3}, {2, 1, 3}}),
      polygon("wall", {{0, 2, 0}, {3, 2, 0}, {3, 2, 3}, {0, 2, 3}}),
  };
  const Mesh mesh = generate_mesh(geometry, options({4, 4, 4}));
  expect_fills(geometry.box, mesh);
  EXPECT_NEAR(area_of(mesh, 0), 3, round_off);
  EXPECT_NEAR(area_of(mesh, 1), 9, round_off);
  EXPECT_NEAR(junction_length(mesh), 2, round_off);
  EXPECT_NEAR(length_of(mesh, Ridge::Kind::on_boundary), 6, round_off);
  // The normal is that about which the points turn.
  EXPECT_NEAR(mesh.fracture_cells[0].normal.x(), 1, round_off);
  EXPECT_NEAR(mesh.fracture_cells[mesh.fractures[1].first_cell].normal.y(), -1, round_off);
}

TEST_P(StructuredInSpace, RefusesWhatLeavesTheGrid) {
  Geometry geometry = box({0, 0, 0}, {4, 4, 4});
  geometry.fractures = {polygon("off", {{2, 1, 1}, {2, 3, 1}, {2, 3, 2.5}, {2, 1, 2.5}})};
  EXPECT_THAT(refusal(geometry, options({4, 4, 4})),
              AllOf(HasSubstr("fracture 'off' does not follow the structured mesh"), HasSubstr("4 x 4 x 4"),
                    HasSubstr("at (2, 3, 2.5)"), HasSubstr("scene.yaml:5")));
  EXPECT_EQ(refusal(geometry, options({4, 4, 8})), "");
  geometry.fractures.clear();
  geometry.regions = {{"half", {}, {"scene.yaml", 9}, {{{0, 0, 1.5}, {0, 0, 1}}}}};
  EXPECT_THAT(refusal(geometry, options({4, 4, 4})), HasSubstr("region 'half' does not follow the structured mesh"));
  EXPECT_EQ(refusal(geometry, options({4, 4, 8})), "");
}

TEST(StructuredInSpace, FollowsDiagonals) {
  for (const Shape shape : {Shape::wedges, Shape::tetrahedra})
    for (const double begin : {0.0, 1.0}) {  // on either kind of diagonal
      Geometry geometry = box({0, 0, 0}, {4, 4, 4});
      geometry.fractures = {polygon("diagonal", {{begin, 0, 1}, {begin + 3, 3, 1}, {begin + 3, 3, 3}, {begin, 0, 3}})};
      const Mesh mesh = generate_mesh(geometry, {.kind = Kind::structured, .shape = shape, .cells = {4, 4, 4}});
      EXPECT_NEAR(area_of(mesh, 0), 6 * std::sqrt(2.0), round_off);
    }
  Geometry geometry = box({0, 0, 0}, {4, 4, 4});
  geometry.fractures = {polygon("dipping", {{1, 0, 0}, {1, 0, 4}, {1, 4, 4}, {1, 4, 0}}),
                        polygon("slope", {{0, 0, 1}, {4, 0, 1}, {4, 3, 4}, {0, 3, 4}})};
  const Mesh mesh = generate_mesh(geometry, {.kind = Kind::structured, .shape = Shape::tetrahedra, .cells = {4, 4, 4}});
  EXPECT_NEAR(area_of(mesh, 1), 12 * std::sqrt(2.0), round_off);
  EXPECT_NEAR(junction_length(mesh), 3 * std::sqrt(2.0), round_off);
  EXPECT_NE(refusal(geometry, {.kind = Kind::structured, .shape = Shape::wedges, .cells = {4, 4, 4}}), "");
}

TEST(UnstructuredInSpace, FillsTheBox) {
  const Geometry geometry = box({1e5, -3, 0.5}, {1e5 + 20, 7, 5.5});
  const Mesh mesh = generate_mesh(geometry, {.size = 1.5});
  expect_fills(geometry.box, mesh);
  EXPECT_EQ(euler_characteristic(mesh), 1);
  EXPECT_GT(mesh_quality(mesh).smallest_angle, 5 * pi / 180);
}

/// Two rectangles in general position that cross along a line, and a third one that ends on the first.
Geometry crossing_rectangles() {
  Geometry geometry = box({0, 0, 0}, {10, 10, 10});
  const Eigen::AngleAxisd turn(0.7, Point(1, 2, 3).normalized());
  const auto rectangle = [&](const std::string& name, const Point& from, const Point& one, const Point& other) {
    std::vector<Point> points;
    for (const Point& x : {from, Point(from + one), Point(from + one + other), Point(from + other)})
      points.push_back(Point(5, 5, 5) + turn * x);
    return polygon(name, points);
  };
  geometry.fractures = {
      rectangle("first", {-2.1, -1.7, 0}, {4, 0, 0}, {0, 4, 0}),
      rectangle("across", {0.3, -1.2, -1.1}, {0, 2.5, 0}, {0, 0, 2.3}),
      rectangle("on_first", {-1.5, -1, 0}, {1, 0.5, 0}, {0, 0, 1.7}),
  };
  return geometry;
}

TEST(UnstructuredInSpace, PolygonsThatCrossAndTouch) {
  const Geometry geometry = crossing_rectangles();
  const Mesh mesh = generate_mesh(geometry, {.size = 1.5, .fracture_size = 0.6});
  expect_fills(geometry.box, mesh);
  EXPECT_NEAR(area_of(mesh, 0), 16, round_off);
  EXPECT_NEAR(area_of(mesh, 1), 2.5 * 2.3, round_off);
  EXPECT_NEAR(area_of(mesh, 2), std::sqrt(1.25) * 1.7, round_off);
  EXPECT_NEAR(junction_length(mesh), 2.5 + std::sqrt(1.25), round_off);
  // Rims that end on nothing: all of the first and of the second one, three sides of the third.
  EXPECT_NEAR(length_of(mesh, Ridge::Kind::tip), 16 + 2 * (2.5 + 2.3) + std::sqrt(1.25) + 2 * 1.7, round_off);
  EXPECT_GT(mesh_quality(mesh).smallest_angle, 5 * pi / 180);
  for (std::size_t f = 0; f < 3; ++f) {
    const FlatShape shape(geometry.fractures[f]);
    const auto& [name, first, count] = mesh.fractures[f];
    EXPECT_EQ(name, geometry.fractures[f].name);
    for (int i = first; i < first + count; ++i) ASSERT_NEAR(mesh.fracture_cells[i].normal.dot(shape.normal()), 1, 1e-9);
  }
}

TEST(UnstructuredInSpace, TheSameBitsAgain) {
  const Geometry geometry = crossing_rectangles();
  const MeshOptions options{.size = 1.5, .fracture_size = 0.6};
  const Mesh one = generate_mesh(geometry, options), other = generate_mesh(geometry, options);
  EXPECT_EQ(one.nodes, other.nodes);
  EXPECT_EQ(one.cell_nodes, other.cell_nodes);
  EXPECT_EQ(one.face_nodes, other.face_nodes);
}

TEST(UnstructuredInSpace, ThreePolygonsThroughAPoint) {
  Geometry geometry = box({-3, -3, -3}, {3, 3, 3});
  const Eigen::AngleAxisd turn(0.5, Point(3, 1, 2).normalized());
  for (int axis = 0; axis < 3; ++axis) {
    const Point one = turn * Point::Unit((axis + 1) % 3), other = turn * Point::Unit((axis + 2) % 3);
    geometry.fractures.push_back(
        polygon(std::string(1, "abc"[axis]), {-one - other, one - other, one + other, -one + other}));
  }
  const Mesh mesh = generate_mesh(geometry, {.size = 1, .fracture_size = 0.5});
  expect_fills(geometry.box, mesh);
  for (int f = 0; f < 3; ++f) EXPECT_NEAR(area_of(mesh, f), 4, round_off);
  EXPECT_NEAR(junction_length(mesh), 6, round_off);
  int copies = 0;
  for (const Point& node : mesh.nodes) copies += node.norm() < 1e-9;
  EXPECT_EQ(copies, 8);
}

TEST(UnstructuredInSpace, PolygonsThatEndOnSides) {
  Geometry geometry = box({0, 0, 0}, {4, 4, 4});
  // From the left side through to the right one, dipping; and one that ends on the top.
  geometry.fractures = {polygon("through", {{0, 1, 1}, {4, 1, 1.5}, {4, 3, 2.5}, {0, 3, 2}}),
                        polygon("upright", {{1.5, 1.2, 1}, {2.5, 2.4, 1}, {2.5, 2.4, 4}, {1.5, 1.2, 4}})};
  const Mesh mesh = generate_mesh(geometry, {.size = 0.7});
  expect_fills(geometry.box, mesh);
  std::map<std::string, double> ends;
  for (const Ridge& ridge : mesh.ridges)
    if (ridge.kind == Ridge::Kind::on_boundary) ends[mesh.side_names[ridge.side]] += ridge.measure;
  EXPECT_EQ(ends.size(), 3U);
  EXPECT_NEAR(ends["left"], std::sqrt(5.0), round_off);
  EXPECT_NEAR(ends["right"], std::sqrt(5.0), round_off);
  EXPECT_NEAR(ends["top"], std::hypot(1, 1.2), round_off);
  EXPECT_NEAR(area_of(mesh, 0), FlatShape(geometry.fractures[0]).area(), round_off);
  EXPECT_NEAR(area_of(mesh, 1), 3 * std::hypot(1, 1.2), round_off);
}

TEST(UnstructuredInSpace, NodesOfRimsLieOnTheirCurve) {
  Geometry geometry = box({0, 0, 0}, {10, 10, 10});
  const StrikeAndDip plane{35 * pi / 180, 50 * pi / 180}, other{200 * pi / 180, 75 * pi / 180};
  geometry.fractures = {disc("disc", ellipse({4, 5, 5}, plane, 2, 2)),
                        disc("ellipse", ellipse({5, 5, 5}, other, 1, 2.5))};
  const Mesh mesh = generate_mesh(geometry, {.size = 1.5, .fracture_size = 0.4});
  expect_fills(geometry.box, mesh);
  for (int f = 0; f < 2; ++f) {
    const Ellipse& rim = *geometry.fractures[f].ellipse;
    const double area = pi * rim.one_axis.norm() * rim.other_axis.norm();
    EXPECT_LT(area_of(mesh, f), area);
    EXPECT_GT(area_of(mesh, f), 0.98 * area);
    int on_rim = 0;
    for (const Ridge& ridge : mesh.ridges) {
      if (ridge.kind != Ridge::Kind::tip || mesh.fracture_cells[ridge.cells[0]].fracture != f) continue;
      // The ends of the edge: the nodes of its cell that are half its length away.
      for (const int node : mesh.face_nodes[mesh.fracture_cells[ridge.cells[0]].faces[0]]) {
        const Point x = mesh.nodes[node] - rim.center;
        if (std::abs((mesh.nodes[node] - ridge.center).norm() - ridge.measure / 2) > 1e-9) continue;
        ++on_rim;
        const double one = x.dot(rim.one_axis) / rim.one_axis.squaredNorm();
        const double across = x.dot(rim.other_axis) / rim.other_axis.squaredNorm();
        EXPECT_NEAR(std::hypot(one, across), 1, 1e-9);
        EXPECT_NEAR(x.dot(rim.one_axis.cross(rim.other_axis)), 0, 1e-9);
      }
    }
    EXPECT_GT(on_rim, 40);
  }
  EXPECT_GT(mesh.junctions.size(), 0U);
}

// Polygons that cross a disc and end beside its rim, where cells are coarse: an edge of the rim that passed on the
// other side of this end would cross the polygon.
TEST(UnstructuredInSpace, EdgesOfRimsClearWhatEndsBesideThem) {
  const Eigen::AngleAxisd turn(0.8, Point(2, -1, 3).normalized());
  for (const double gap_edges : {0.0, 0.5})
    for (const bool mirrored : {false, true})
      for (const double gap : {0.2, 0.03, 0.001}) {
        Geometry geometry = box({-4, -4, -4}, {4, 4, 4});
        const auto place = [&](double x, double y, double z) {
          const Point at = turn * Point(x, y, z);
          return mirrored ? Point(-at.x(), at.y(), at.z()) : at;
        };
        constexpr double radius = 2;
        geometry.fractures = {disc("disc", {place(0, 0, 0), place(radius, 0, 0), place(0, radius, 0)})};
        double crossing = 0;
        for (const double angle : {0.3, 2.5, 4.1}) {
          const double from = 0.5, to = radius - gap, x = std::cos(angle), y = std::sin(angle);
          crossing += to - from;
          geometry.fractures.push_back(
              polygon(fmt::format("at_{}", angle), {place(from * x, from * y, -0.7), place(to * x, to * y, -0.7),
                                                    place(to * x, to * y, 0.9), place(from * x, from * y, 0.9)}));
        }
        const Mesh mesh = generate_mesh(geometry, {.size = 3, .gap_edges = gap_edges});
        expect_fills(geometry.box, mesh);
        EXPECT_NEAR(junction_length(mesh), crossing, 1e-9);
        for (int f = 1; f < 4; ++f) EXPECT_NEAR(area_of(mesh, f), 1.6 * crossing / 3, 1e-9);
      }
}

// The rim of a disc that touches nothing has no place that is narrow.
TEST(UnstructuredInSpace, RimsOfLoneDiscsAreNotRefined) {
  Geometry geometry = box({0, 0, 0}, {10, 10, 10});
  geometry.fractures = {disc("disc", ellipse({4, 5, 5}, {35 * pi / 180, 50 * pi / 180}, 2, 2))};
  const Mesh refined = generate_mesh(geometry, {.size = 1, .gap_edges = 1}),
             plain = generate_mesh(geometry, {.size = 1, .gap_edges = 0});
  EXPECT_EQ(refined.nodes, plain.nodes);
}

TEST(UnstructuredInSpace, StrikeIsClockwiseFromNorthAndTheDipToItsRight) {
  // Strike north, dip 30 degrees to the east: the eastern edge is the lower one.
  const auto corners = rectangle({0, 0, 0}, {0, pi / 6}, 4, 2);
  const FlatShape shape(corners);
  EXPECT_NEAR(shape.area(), 8, round_off);
  EXPECT_LT((shape.normal() - Point(0.5, 0, std::sqrt(0.75))).norm(), round_off);
  for (const Point& corner : corners) {
    EXPECT_NEAR(std::abs(corner.y()), 2, round_off);
    EXPECT_NEAR(corner.z(), -corner.x() * std::tan(pi / 6), round_off);
  }
  // Strike east, upright: to the right is south.
  EXPECT_LT((FlatShape(rectangle({1, 2, 3}, {pi / 2, pi / 2}, 4, 2)).normal() - Point(0, -1, 0)).norm(), round_off);
}

TEST(RegionsInSpace, AreWhatTheirPlanesBound) {
  Geometry geometry = box({0, 0, 0}, {4, 4, 4});
  const auto region = [](const std::string& name, const std::vector<HalfSpace>& half_spaces) {
    return RegionGeometry{name, {}, {"scene.yaml", 9}, half_spaces};
  };
  geometry.regions = {
      region("corner", {{{2.9, 2.9, 2.9}, {1, 1, 1}}}),
      region(
          "block",
          {{{0.5, 0, 0}, {1, 0, 0}}, {{1.5, 0, 0}, {-1, 0, 0}}, {{0, 0.5, 0}, {0, 1, 0}}, {{0, 1.5, 0}, {0, -1, 0}}}),
  };
  const Mesh mesh = generate_mesh(geometry, {.size = 0.8});
  expect_fills(geometry.box, mesh);
  EXPECT_EQ(mesh.region_names[1], "corner");
  EXPECT_NEAR(volume_of(mesh, 1), std::pow(3.3, 3) / 6, 1e-8);
  EXPECT_NEAR(volume_of(mesh, 2), 4, 1e-8);
}

TEST(GeometryInSpace, RefusesWhatIsNoFracture) {
  const auto with = [](const std::vector<FractureGeometry>& fractures) {
    Geometry geometry = box({0, 0, 0}, {4, 4, 4});
    geometry.fractures = fractures;
    return refusal(geometry, {.size = 1});
  };
  EXPECT_THAT(with({polygon("out", {{1, 1, 1}, {3, 1, 1}, {3, 1, 4.5}})}),
              AllOf(HasSubstr("fracture 'out' leaves the box"), HasSubstr("(3, 1, 4.5) lies 0.5 m outside")));
  EXPECT_THAT(with({polygon("bent", {{1, 1, 1}, {3, 1, 1}, {3, 3, 1.2}, {1, 3, 1}})}),
              AllOf(HasSubstr("fracture 'bent' is not flat"), HasSubstr("m off the plane")));
  EXPECT_THAT(with({polygon("bow", {{1, 1, 1}, {3, 3, 1}, {3, 1, 1}, {1, 3, 1}})}),
              AllOf(HasSubstr("fracture 'bow' meets itself"), HasSubstr("edges 1 and 3 meet near (2, 2, 1)")));
  EXPECT_THAT(with({polygon("line", {{1, 1, 1}, {3, 1, 1}})}), HasSubstr("has fewer than three points"));
  EXPECT_THAT(with({polygon("line", {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}})}), HasSubstr("fracture 'line'"));
  EXPECT_THAT(with({polygon("twice", {{1, 1, 1}, {1, 1, 1}, {3, 3, 1}, {1, 3, 1}})}),
              HasSubstr("the same point twice"));
  EXPECT_THAT(with({polygon("skin", {{0, 1, 1}, {0, 3, 1}, {0, 3, 3}})}), HasSubstr("runs along the boundary"));
  EXPECT_THAT(with({polygon("a", {{1, 1, 1}, {3, 1, 1}, {3, 3, 1}, {1, 3, 1}}),
                    polygon("b", {{2, 2, 1}, {3.5, 2, 1}, {3.5, 3.5, 1}, {2, 3.5, 1}})}),
              AllOf(HasSubstr("fracture 'b' overlaps fracture 'a'"), HasSubstr("both cover (")));
  EXPECT_THAT(with({polygon("a", {{1, 1, 1}, {3, 1, 1}, {3, 3, 1}, {1, 3, 1}}),
                    polygon("b", {{2, 2, 1.000001}, {2.5, 2, 3}, {2, 2.5, 3}})}),
              AllOf(HasSubstr("fracture 'b' nearly touches fracture 'a'"), HasSubstr("1e-06 m apart")));
  // They may share an edge in one plane.
  EXPECT_EQ(with({polygon("a", {{1, 1, 1}, {3, 1, 1}, {3, 3, 1}, {1, 3, 1}}),
                  polygon("b", {{3, 1, 1}, {3.5, 1, 1}, {3.5, 3, 1}, {3, 3, 1}})}),
            "");
  EXPECT_THAT(with({disc("round", ellipse({1, 2, 2}, {0, pi / 4}, 1.5, 1.5))}),
              AllOf(HasSubstr("fracture 'round' leaves the box"), HasSubstr("at (")));
}

}  // namespace
}  // namespace sprekk
