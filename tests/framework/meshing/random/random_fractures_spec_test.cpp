#include "framework/meshing/random/random_fractures_spec.hpp"

#include "framework/config/yaml/parse_yaml.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/spec/geometry_spec.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Geometry read(const std::string& fractures) {
  Geometry geometry;
  geometry_spec(geometry).read(
      parse_yaml("box: {x: [0 m, 10 m], y: [0 m, 10 m]}\nfractures:\n" + fractures, "scene.yaml"), {});
  return geometry;
}

/// The message of a set with these parameters.
std::string mistake(const std::string& parameters) {
  try {
    read("  joints: {random: {" + parameters + "}}\n");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RandomFractureSpec, SetsComeAfterAllOtherFracturesAndKeepAwayFromThem) {
  const Geometry geometry = read(R"(
  joints:
    random:
      number: 12
      length: {law: power, exponent: 2, from: 50 cm, to: 2 m}
      orientation: {mean: 90 deg, concentration: 1e4}
      region: {x: [2 m, 8 m], y: [1 m, 9 m]}
      gap: 10 cm
      seed: 3
  fault: {points: [[0 m, 0 m], [9 m, 8 m]]}
)");
  ASSERT_EQ(geometry.fractures.size(), 13u);
  EXPECT_EQ(geometry.fractures[0].name, "fault");
  EXPECT_EQ(geometry.fractures[12].name, "joints_12");
  EXPECT_EQ(geometry.fractures[12].origin.line, 4);
  for (std::size_t i = 1; i < 13; ++i) {
    const auto& points = geometry.fractures[i].points;
    EXPECT_LT(std::abs(points[1].x() - points[0].x()), 0.1 * std::abs(points[1].y() - points[0].y()));
    for (const Point& point : points) EXPECT_GE(distance(point, Segment{{0, 0}, {9, 8}}), 0.1);
  }
}

TEST(RandomFractureSpec, DifferentNamesMakeDifferentSets) {
  const Geometry geometry = read(
      "  a: {random: {number: 1, length: {value: 1 m}}}\n"
      "  b: {random: {number: 1, length: {value: 1 m}}}\n");
  ASSERT_EQ(geometry.fractures.size(), 2u);
  EXPECT_NE(geometry.fractures[0].points, geometry.fractures[1].points);
}

TEST(RandomFractureSpec, RefusesWhatCannotBeDrawn) {
  const std::string length = "length: {value: 1 m}";
  EXPECT_EQ(mistake("number: 5, " + length), "");
  EXPECT_THAT(mistake(length), AllOf(HasSubstr("needs one of number, density and intensity"), HasSubstr("0 of them")));
  EXPECT_THAT(mistake("number: 5, density: 0.1 1/m^2, " + length), HasSubstr("2 of them"));
  EXPECT_THAT(mistake("number: 5.5, " + length), HasSubstr("not whole"));
  EXPECT_THAT(mistake("number: 0, " + length), HasSubstr("number"));
  EXPECT_THAT(mistake("density: 0.1 1/m, " + length), HasSubstr("density"));
  EXPECT_THAT(mistake("number: 5"), HasSubstr("length"));
  EXPECT_THAT(mistake("number: 5, length: {law: power, from: 1 m, to: 2 m}"), HasSubstr("has no 'exponent'"));
  EXPECT_THAT(mistake("number: 5, length: {value: 1 m, to: 2 m}"), HasSubstr("no use for 'to'"));
  EXPECT_THAT(mistake("number: 5, length: {law: power, exponent: 2, from: 2 m, to: 1 m}"), HasSubstr("raise 'to'"));
  EXPECT_THAT(mistake("number: 5, length: {law: lognormal, median: 1 m, deviation: 0.2, from: 5 m, to: 9 m}"),
              HasSubstr("hardly any of the law"));
  EXPECT_EQ(mistake("number: 5, length: {law: lognormal, median: 1 m, deviation: 0.2, from: 1.85 m, to: 9 m}"), "");
  EXPECT_THAT(mistake("number: 5, length: {law: lognormal, median: 1 m, deviation: 0.2, from: 1.9 m, to: 9 m}"),
              HasSubstr("hardly any of the law"));  // the share above 1.9 is 6.6e-4, above 1.85 it is 1.05e-3
  EXPECT_THAT(mistake("number: 5, orientation: {mean: 3 deg}, " + length), HasSubstr("concentration"));
  EXPECT_THAT(mistake("number: 5, angle: 90 deg, " + length), HasSubstr("angle"));
  EXPECT_THAT(mistake("number: 5, region: {x: [3 m, 2 m], y: [0 m, 1 m]}, " + length), HasSubstr("two growing values"));
  EXPECT_THAT(mistake("number: 5, region: {x: [3 m, 12 m], y: [0 m, 1 m]}, " + length), HasSubstr("leaves the box"));
  EXPECT_THAT(mistake("number: 5, sead: 3, " + length), HasSubstr("seed"));
  EXPECT_THAT(mistake("number: 5, length: {value: 20 m}"), HasSubstr("no place for fracture 1 of 5"));
}

TEST(RandomFractureSpec, RefusesFurtherParametersAndMeshFiles) {
  const auto message = [](const std::string& yaml) -> std::string {
    Geometry geometry;
    try {
      geometry_spec(geometry).read(parse_yaml(yaml, "scene.yaml"), {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string set = "random: {number: 5, length: {value: 1 m}}";
  EXPECT_THAT(message("box: {x: [0, 9], y: [0, 9]}\nfractures: {a: {" + set + ", size: 1 m}}"),
              HasSubstr("remove 'size'"));
  EXPECT_THAT(message("file: some.msh\nfractures: {a: {" + set + "}}"), HasSubstr("together with a mesh file"));
}

}  // namespace
}  // namespace sprekk::test
