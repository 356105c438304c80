#include "framework/meshing/spec/geometry_spec.hpp"
#include "framework/config/yaml/parse_yaml.hpp"

#include "framework/meshing/validate_geometry.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Geometry read_geometry(const std::string& yaml, const std::string& folder = ".") {
  Geometry geometry;
  geometry_spec(geometry, folder).read(parse_yaml(yaml, "scene.yaml"), {});
  return geometry;
}

MeshOptions read_mesh(const std::string& yaml) {
  MeshOptions options;
  mesh_spec(options).read(parse_yaml(yaml, "scene.yaml"), {});
  return options;
}

TEST(GeometrySpec, ReadsBoxFracturesAndRegions) {
  const Geometry geometry = read_geometry(R"(
box: {x: [0 m, 2 m], y: [-50 cm, 2 m]}
fractures:
  main: {points: [[0.96 m, 0.96 m], [1.04 m, 1.04 m]], size: 2 mm}
  straight: {center: [1 m, 0.5 m], length: 0.2 m, angle: 30 deg}
regions:
  lens: {polygon: [[0.2 m, 0.2 m], [0.5 m, 0.2 m], [0.5 m, 0.4 m]]}
)");
  EXPECT_EQ(geometry.box.low, Point(0, -0.5));
  EXPECT_EQ(geometry.box.high, Point(2, 2));
  EXPECT_FALSE(geometry.is_imported());
  ASSERT_EQ(geometry.fractures.size(), 2u);
  EXPECT_EQ(geometry.fractures[0].name, "main");
  EXPECT_EQ(geometry.fractures[0].points, (std::vector<Point>{{0.96, 0.96}, {1.04, 1.04}}));
  EXPECT_DOUBLE_EQ(geometry.fractures[0].size.value(), 0.002);
  EXPECT_EQ(geometry.fractures[0].origin.line, 4);
  const auto& straight = geometry.fractures[1].points;
  EXPECT_FALSE(geometry.fractures[1].size.has_value());
  EXPECT_NEAR((straight[1] - Point(1 + 0.1 * std::sqrt(0.75), 0.55)).norm(), 0, 1e-15);
  EXPECT_NEAR((straight[0] + straight[1] - Point(2, 1)).norm(), 0, 1e-15);
  ASSERT_EQ(geometry.regions.size(), 1u);
  EXPECT_EQ(geometry.regions[0].name, "lens");
  EXPECT_EQ(geometry.regions[0].polygon.size(), 3u);
  EXPECT_NO_THROW(validate_geometry(geometry, {}));
}

TEST(GeometrySpec, FindsMeshFilesNextToTheScene) {
  const Geometry geometry = read_geometry("file: some.msh", "scenes");
  EXPECT_EQ(geometry.file, "scenes/some.msh");
  EXPECT_EQ(geometry.file_origin.line, 1);
  EXPECT_EQ(read_geometry("file: /meshes/some.msh", "scenes").file, "/meshes/some.msh");
}

TEST(GeometrySpec, RefusesContradictions) {
  const std::string box = "box: {x: [0, 1], y: [0, 1]}\n";
  EXPECT_THAT(input_error([&] { read_geometry(box + "file: a.msh"); }), HasSubstr("a box and a file"));
  EXPECT_THAT(input_error([&] { read_geometry("fractures: {}"); }), HasSubstr("neither box nor file"));
  EXPECT_THAT(input_error([&] { read_geometry("box: {x: [0, 1, 2], y: [0, 1]}"); }),
              AllOf(HasSubstr("scene.yaml:1"), HasSubstr("two values along x"), HasSubstr("3 are given")));
  EXPECT_THAT(input_error([&] { read_geometry(box + "fractures: {a: {length: 1 m}}"); }),
              AllOf(HasSubstr("scene.yaml:2"), HasSubstr("fracture 'a' is not given completely")));
  EXPECT_THAT(input_error([&] { read_geometry(box + "fractures: {a: {}}"); }), HasSubstr("not given completely"));
  EXPECT_THAT(input_error([&] { read_geometry(box + "fractures: {a: {points: [[0, 0], [1, 1]], angle: 3 deg}}"); }),
              HasSubstr("fracture 'a' is given twice"));
  EXPECT_THAT(input_error([&] { read_geometry(box + "fractures: {a: {center: [0, 0], length: 0 m}}"); }),
              HasSubstr("length"));
  EXPECT_THAT(input_error([&] { read_geometry(box + "fractures: {a: {centre: [0, 0], length: 1 m}}"); }),
              HasSubstr("center"));
  EXPECT_THAT(input_error([&] { read_geometry(box + "regions: {a: {}}"); }), HasSubstr("polygon"));
}

TEST(GeometrySpec, ExplainsItselfWithoutAnInput) {
  Geometry geometry;
  MeshOptions options;
  EXPECT_THAT(explain(geometry_spec(geometry)),
              AllOf(HasSubstr("fractures"), HasSubstr("polygon"), HasSubstr("center")));
  EXPECT_THAT(explain(mesh_spec(options)), AllOf(HasSubstr("tip_size"), HasSubstr("structured")));
  EXPECT_THAT(json_schema(geometry_spec(geometry)), HasSubstr("\"angle\""));
}

TEST(MeshSpec, ReadsSizes) {
  const MeshOptions options = read_mesh("{size: 0.02 m, fracture_size: 5 mm, tip_size: 1 mm, growth: 0.2}");
  EXPECT_EQ(options.kind, MeshOptions::Kind::unstructured);
  EXPECT_DOUBLE_EQ(options.size.value(), 0.02);
  EXPECT_DOUBLE_EQ(options.fracture_size.value(), 0.005);
  EXPECT_DOUBLE_EQ(options.tip_size.value(), 0.001);
  EXPECT_DOUBLE_EQ(options.growth, 0.2);
  EXPECT_EQ(options.origin.line, 1);
}

TEST(MeshSpec, DefaultsLeaveSizesToTheGeometry) {
  const MeshOptions options = read_mesh("{}");
  EXPECT_FALSE(options.size || options.fracture_size || options.tip_size);
  EXPECT_DOUBLE_EQ(options.growth, 0.3);
  EXPECT_DOUBLE_EQ(far_size(box(0, 2, 0, 5), options), 0.1);
}

TEST(MeshSpec, ReadsStructuredMeshes) {
  const MeshOptions options = read_mesh("{kind: structured, cells: [20, 10], distortion: 0.3, seed: 5}");
  EXPECT_EQ(options.kind, MeshOptions::Kind::structured);
  EXPECT_EQ(options.cells, (std::array{20, 10}));
  EXPECT_DOUBLE_EQ(options.distortion, 0.3);
  EXPECT_EQ(options.seed, 5);
  EXPECT_EQ(options.shape, MeshOptions::Shape::triangles);
  EXPECT_EQ(read_mesh("{kind: structured, shape: quadrilaterals}").shape, MeshOptions::Shape::quadrilaterals);
  EXPECT_THAT(input_error([] { read_mesh("{shape: squares}"); }), HasSubstr("quadrilaterals"));
}

TEST(MeshSpec, RefusesWrongValues) {
  EXPECT_THAT(input_error([] { read_mesh("{kind: structured, cells: [20]}"); }), HasSubstr("two whole numbers"));
  EXPECT_THAT(input_error([] { read_mesh("{kind: structured, cells: [2.5, 3]}"); }), HasSubstr("two whole numbers"));
  EXPECT_THAT(input_error([] { read_mesh("{cells: [20, 20]}"); }), HasSubstr("no cells along x and y"));
  EXPECT_THAT(input_error([] { read_mesh("{size: -1 m}"); }), HasSubstr("size"));
  EXPECT_THAT(input_error([] { read_mesh("{size: 1 s}"); }), HasSubstr("size"));
  EXPECT_THAT(input_error([] { read_mesh("{tipsize: 1 mm}"); }), HasSubstr("tip_size"));
  EXPECT_THAT(input_error([] { read_mesh("{growth: 0}"); }), HasSubstr("growth"));
  EXPECT_THAT(input_error([] { read_mesh("{kind: strutured}"); }), HasSubstr("structured"));
}

}  // namespace
}  // namespace sprekk::test
