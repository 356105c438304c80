#include "framework/meshing/geometry.hpp"

#include <limits>

#include "framework/meshing/plane/size_field.hpp"
#include "framework/meshing/validate_geometry.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refusal(const Geometry& geometry, const MeshOptions& options = {}) {
  return input_error([&] { validate_geometry(geometry, options); });
}

std::string refusal_of(std::vector<FractureGeometry> fractures) {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = std::move(fractures);
  return refusal(geometry);
}

std::string refusal_of(const RegionGeometry& polygon) {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.regions = {polygon};
  return refusal(geometry);
}

std::string refusal_of(const MeshOptions& options) { return refusal(paper_geometry(), options); }

TEST(ValidateGeometry, AcceptsFracturesThatEndOnTheBoundary) {
  Geometry geometry = paper_geometry();
  geometry.fractures.push_back(fracture("edge", {{2, 0.5}, {1.5, 0.5}, {1.2, 0.3}}));
  geometry.regions = {region("layer", {{0, 1.5}, {2, 1.5}, {2, 2}, {0, 2}})};
  EXPECT_NO_THROW(validate_geometry(geometry, {}));
}

TEST(ValidateGeometry, RefusesEmptyBox) {
  EXPECT_THAT(refusal(box(1, 1, 0, 2)), AllOf(HasSubstr("scene.yaml:2:3"), HasSubstr("the box is empty along x")));
  EXPECT_THAT(refusal(box(0, 1, 2, 0)), HasSubstr("the box is empty along y"));
  EXPECT_THAT(refusal(box(0, std::nan(""), 0, 2)), HasSubstr("no finite number"));
}

TEST(ValidateGeometry, RefusesFracturesOutsideTheBox) {
  EXPECT_THAT(refusal_of({fracture("far", {{1, 1}, {2.5, 1}})}),
              AllOf(HasSubstr("scene.yaml:4:5"), HasSubstr("fracture 'far' leaves the box"), HasSubstr("(2.5, 1)"),
                    HasSubstr("x from 0 to 2")));
}

TEST(ValidateGeometry, RefusesDegenerateFractures) {
  EXPECT_THAT(refusal_of({fracture("point", {{1, 1}})}), HasSubstr("fewer than two points"));
  EXPECT_THAT(refusal_of({fracture("none", {})}), HasSubstr("fewer than two points"));
  EXPECT_THAT(refusal_of({fracture("zero", {{1, 1}, {1, 1}})}), HasSubstr("a segment of length zero"));
  EXPECT_THAT(refusal_of({fracture("twice", {{0.5, 1}, {1, 1}, {1, 1}, {1.5, 1}})}),
              HasSubstr("points 2 and 3 are both (1, 1)"));
  EXPECT_THAT(refusal_of({fracture("nan", {{1, std::nan("")}, {1, 1}})}), HasSubstr("no finite number"));
}

TEST(ValidateGeometry, RefusesFracturesThatMeetTheBoundaryBetweenTheirEnds) {
  EXPECT_THAT(refusal_of({fracture("side", {{0.5, 0}, {1, 0}})}), HasSubstr("runs along the boundary"));
  EXPECT_THAT(refusal_of({fracture("bounce", {{0.5, 0.5}, {1, 0}, {1.5, 0.5}})}),
              HasSubstr("touches the boundary between its ends"));
}

TEST(ValidateGeometry, FracturesMayCrossAndTouch) {
  const auto a = fracture("a", {{0.5, 1}, {1.5, 1}}, 4);
  for (const FractureGeometry& b : {fracture("b", {{1, 0.5}, {1, 1.5}}), fracture("b", {{1, 1}, {1, 1.5}}),
                                    fracture("b", {{1.5, 1}, {1.8, 1.5}}), fracture("b", {{1.5, 1}, {1.8, 1}})}) {
    Geometry geometry = box(0, 2, 0, 2);
    geometry.fractures = {a, b};
    EXPECT_NO_THROW(validate_geometry(geometry, {}));
  }
}

TEST(ValidateGeometry, RefusesFracturesThatOverlapOrMeetOnTheBoundary) {
  const auto a = fracture("a", {{0.5, 1}, {1.5, 1}}, 4);
  EXPECT_THAT(refusal_of({a, fracture("b", {{1.2, 1}, {1.8, 1}}, 7)}),
              AllOf(HasSubstr("scene.yaml:7:5"), HasSubstr("fracture 'b' overlaps fracture 'a'"),
                    HasSubstr("scene.yaml:4:5"), HasSubstr("end one where they meet")));
  EXPECT_THAT(refusal_of({fracture("a", {{0, 1}, {1, 1}}), fracture("b", {{0, 1}, {1, 0.5}})}),
              AllOf(HasSubstr("fracture 'b' meets fracture 'a' at (0, 1)"), HasSubstr("outer boundary")));
  EXPECT_THAT(refusal_of({a, a}), HasSubstr("two fractures are called 'a'"));
}

TEST(ValidateGeometry, RefusesFracturesThatMeetThemselves) {
  EXPECT_THAT(refusal_of({fracture("cross", {{0.5, 0.5}, {1.5, 0.5}, {1, 1}, {1, 0.2}})}),
              AllOf(HasSubstr("fracture 'cross' meets itself"), HasSubstr("segments 1 and 3")));
  EXPECT_THAT(refusal_of({fracture("back", {{0.5, 0.5}, {1.5, 0.5}, {1, 0.5}})}), HasSubstr("segments 1 and 2"));
  EXPECT_THAT(refusal_of({fracture("loop", {{0.5, 0.5}, {1.5, 0.5}, {1, 1}, {0.5, 0.5}})}),
              HasSubstr("segments 1 and 3"));
}

TEST(ValidateGeometry, RefusesWrongPolygons) {
  EXPECT_THAT(refusal_of(region("thin", {{0, 0}, {1, 1}})),
              AllOf(HasSubstr("scene.yaml:9:5"), HasSubstr("region 'thin' has fewer than three points")));
  EXPECT_THAT(refusal_of(region("line", {{0, 0}, {1, 1}, {1.5, 1.5}})), HasSubstr("region 'line' has no area"));
  // Bow ties, also one whose halves have the same area: it does not lie on a line.
  for (const double turn : {0.0, 0.3, 2.0})
    for (const double other : {1.0, 1.5}) {
      RegionGeometry bow = region("bow", {{-0.5, -0.5}, {0.5, 0.5}, {0.5, -0.5}, {-0.5, other - 0.5}});
      for (Point& x : bow.polygon)
        x = Point(1 + std::cos(turn) * x.x() - std::sin(turn) * x.y(),
                  1 + std::sin(turn) * x.x() + std::cos(turn) * x.y());
      EXPECT_THAT(refusal_of(bow), AllOf(HasSubstr("region 'bow' crosses itself"), HasSubstr("edges 1 and 3 cross at"),
                                         testing::Not(HasSubstr("lie on a line"))));
    }
  EXPECT_THAT(refusal_of(region("bow", {{0, 0}, {1, 1}, {1, 0}, {0, 1}})), HasSubstr("cross at (0.5, 0.5)"));
  EXPECT_THAT(refusal_of(region("touch", {{0, 0}, {1, 0}, {1, 1}, {0.5, 0}, {0, 1}})), HasSubstr("meets itself"));
  EXPECT_THAT(refusal_of(region("closed", {{0, 0}, {1, 0}, {1, 1}, {0, 0}})), HasSubstr("the same point twice"));
  EXPECT_THAT(refusal_of(region("out", {{0, 0}, {3, 0}, {1, 1}})), HasSubstr("region 'out' leaves the box"));
  EXPECT_THAT(refusal_of(region("medium", {{0, 0}, {1, 0}, {1, 1}})), HasSubstr("a polygon is called 'medium'"));
}

TEST(ValidateGeometry, TellsAllConflictsTogether) {
  const std::string told = refusal_of({fracture("out", {{1, 1}, {2.5, 1}}), fracture("zero", {{1.5, 1.5}, {1.5, 1.5}}),
                                       fracture("a", {{0, 0.5}, {1, 0.5}}), fracture("b", {{0, 0.5}, {1, 0.2}}),
                                       fracture("c", {{0.5, 0.5}, {1, 0.5}})});
  EXPECT_THAT(told, AllOf(HasSubstr("'out' leaves the box"), HasSubstr("'zero' has a segment of length zero"),
                          HasSubstr("'b' meets fracture 'a'"), HasSubstr("'c' overlaps fracture 'a'")));
}

TEST(ValidateGeometry, RefusesWrongSizes) {
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(refusal_of(MeshOptions{.size = bad}), HasSubstr("mesh size 'size' is"));
    EXPECT_THAT(refusal_of(MeshOptions{.fracture_size = bad}), HasSubstr("mesh size 'fracture_size' is"));
    EXPECT_THAT(refusal_of(MeshOptions{.tip_size = bad}), HasSubstr("mesh size 'tip_size' is"));
    Geometry geometry = paper_geometry();
    geometry.fractures[0].size = bad;
    EXPECT_THAT(refusal(geometry), AllOf(HasSubstr("scene.yaml:4:5"), HasSubstr("mesh size 'size' is")));
  }
  EXPECT_THAT(refusal_of(MeshOptions{.growth = 0}), HasSubstr("mesh growth is 0"));
  EXPECT_THAT(refusal_of(MeshOptions{.growth = std::nan("")}), HasSubstr("mesh growth is"));
  EXPECT_THAT(refusal_of(MeshOptions{.distortion = 0.5}), HasSubstr("mesh distortion is 0.5"));
  EXPECT_THAT(refusal_of(MeshOptions{.cells = {-1, 2}}), HasSubstr("negative number of cells"));
}

TEST(ValidateGeometry, RefusesAbsurdlyManyTriangles) {
  const std::string words = "at most 2e+07 are made";
  EXPECT_THAT(refusal_of(MeshOptions{.size = 1e-5}), AllOf(HasSubstr("triangles"), HasSubstr(words)));
  EXPECT_THAT(refusal_of(MeshOptions{.fracture_size = 1e-9}), HasSubstr(words));
  EXPECT_THAT(refusal_of(MeshOptions{.kind = MeshOptions::Kind::structured, .cells = {100000, 100000}}),
              HasSubstr(words));
  // A tiny size at the tips alone costs little, for it grows again quickly.
  EXPECT_NO_THROW(validate_geometry(paper_geometry(), {.tip_size = 1e-9}));
}

TEST(ValidateGeometry, RefusesFileWithFractures) {
  Geometry geometry;
  geometry.file = "some.msh";
  EXPECT_NO_THROW(validate_geometry(geometry, {}));
  EXPECT_THAT(refusal(geometry, {.kind = MeshOptions::Kind::structured}), HasSubstr("structured"));
  geometry.fractures = {fracture("main", {{0, 0}, {1, 1}})};
  EXPECT_THAT(refusal(geometry), HasSubstr("together with a mesh file"));
}

TEST(SizeField, GrowsLinearlyFromFracturesAndTips) {
  Geometry geometry = box(0, 10, 0, 10);
  geometry.fractures = {fracture("main", {{4, 5}, {6, 5}})};
  const SizeField sizes(geometry, {.size = 1, .fracture_size = 0.2, .tip_size = 0.05, .growth = 0.5});
  EXPECT_DOUBLE_EQ(sizes.at({4, 5}), 0.05);
  EXPECT_DOUBLE_EQ(sizes.at({6, 5}), 0.05);
  EXPECT_DOUBLE_EQ(sizes.at({5, 5}), 0.2);
  EXPECT_DOUBLE_EQ(sizes.at({5, 5.6}), 0.5);
  EXPECT_DOUBLE_EQ(sizes.at({3, 5}), 0.55);
  EXPECT_DOUBLE_EQ(sizes.at({0, 0}), 1);
}

TEST(SizeField, IsTheSmallestOfManySources) {
  Geometry geometry = box(0, 10, 0, 10);
  for (int i = 0; i < 30; ++i) {
    const Point start(0.5 + i % 6 * 1.6, 0.5 + i / 6 * 1.9);
    geometry.fractures.push_back(fracture("f" + std::to_string(i), {start, start + Point(1.2, i % 3 * 0.5)}));
    geometry.fractures.back().size = 0.05 * (1 + i % 4);
  }
  const SizeField sizes(geometry, {.size = 0.5});
  for (double x = 0; x <= 10; x += 0.37) {
    for (double y = 0; y <= 10; y += 0.41) {
      double expected = 0.5;
      for (const auto& f : geometry.fractures) {
        const double d = distance(Point(x, y), Segment{f.points[0], f.points[1]});
        expected = std::min(expected, f.size.value() + 0.3 * d);
      }
      ASSERT_DOUBLE_EQ(sizes.at({x, y}), expected);
    }
  }
}

TEST(SizeField, TipSizeIsNotUsedWhereAFractureEndsOnTheBoundary) {
  Geometry geometry = box(0, 10, 0, 10);
  geometry.fractures = {fracture("edge", {{0, 5}, {6, 5}})};
  geometry.fractures[0].size = 0.3;
  const SizeField sizes(geometry, {.size = 1, .fracture_size = 0.2, .tip_size = 0.05});
  EXPECT_DOUBLE_EQ(sizes.at({0, 5}), 0.3);
  EXPECT_DOUBLE_EQ(sizes.at({6, 5}), 0.05);
}

}  // namespace
}  // namespace sprekk::test
