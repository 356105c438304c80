// What scenes, tables, random sets and mesh files say of geometries in space.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "framework/config/yaml/parse_yaml.hpp"
#include "framework/mesh/quality/mesh_quality.hpp"
#include "framework/meshing/fracture_geojson.hpp"
#include "framework/meshing/fracture_table.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "framework/meshing/random/random_fractures.hpp"
#include "framework/meshing/read_msh.hpp"
#include "framework/meshing/regions.hpp"
#include "framework/meshing/space/flat_shape.hpp"
#include "framework/meshing/spec/geometry_spec.hpp"
#include "tests/space/meshing/measures.hpp"

namespace sprekk {
namespace {

using std::numbers::pi;
using testing::AllOf;
using testing::HasSubstr;

Geometry read_geometry(const std::string& yaml, const std::string& folder = ".") {
  Geometry geometry;
  geometry_spec(geometry, folder).read(parse_yaml(yaml, "scene.yaml"), {});
  return geometry;
}

std::string refusal(const std::string& yaml, const std::string& folder = ".") {
  try {
    read_geometry(yaml, folder);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const std::string cube = "box: {x: [0, 4], y: [0, 4], z: [0, 4]}\n";

TEST(ScenesInSpace, GiveFractures) {
  const Geometry geometry = read_geometry(R"(
box: {x: [0 m, 4 m], y: [-50 cm, 4 m], z: [-3 m, 0 m]}
fractures:
  triangle: {points: [[1, 1, -1], [2, 1, -1], [2, 2, -2]], size: 2 cm}
  rectangle: {center: [2, 2, -1.5], strike: 0 deg, dip: 30 deg, length: 2 m, height: 1 m}
  disc: {center: [2, 2, -1.5], radius: 1 m}
  ellipse: {center: [2, 2, -1.5], strike: 90 deg, dip: 60 deg, radius: [1 m, 0.5 m]}
)");
  EXPECT_EQ(geometry.box.low, Point(0, -0.5, -3));
  EXPECT_EQ(geometry.box.high, Point(4, 4, 0));
  ASSERT_EQ(geometry.fractures.size(), 4U);
  EXPECT_EQ(geometry.fractures[0].points[2], Point(2, 2, -2));
  EXPECT_EQ(geometry.fractures[0].size, 0.02);
  EXPECT_NEAR(FlatShape(geometry.fractures[1]).area(), 2, 1e-12);
  EXPECT_LT((FlatShape(geometry.fractures[1]).normal() - Point(0.5, 0, std::sqrt(0.75))).norm(), 1e-12);
  const Ellipse& disc = *geometry.fractures[2].ellipse;
  EXPECT_LT((disc.one_axis - Point(0, 1, 0)).norm(), 1e-12);
  EXPECT_LT((disc.other_axis - Point(0, 0, 1)).norm(), 1e-12);
  const Ellipse& ellipse = *geometry.fractures[3].ellipse;
  EXPECT_LT((ellipse.one_axis - Point(1, 0, 0)).norm(), 1e-12);
  // It dips south.
  EXPECT_LT((ellipse.other_axis - 0.5 * Point(0, 0.5, std::sqrt(0.75))).norm(), 1e-12);
}

TEST(ScenesInSpace, TakePolygonsOfGeoJson) {
  const auto read = [](const std::string& geometry) {
    return read_fracture_geojson(
        R"({"type": "Feature", "id": 3, "properties": {"opening[mm]": 2}, "geometry": )" + geometry + "}",
        "net.geojson", "net", {});
  };
  const auto fractures =
      read(R"({"type": "Polygon", "coordinates": [[[1, 2, 3], [2, 2.5, 3], [1, 2, 4], [1, 2, 3]]]})");
  ASSERT_EQ(fractures.size(), 1U);
  EXPECT_EQ(fractures[0].name, "3");
  EXPECT_EQ(fractures[0].points, (std::vector<Point>{Point(1, 2, 3), Point(2, 2.5, 3), Point(1, 2, 4)}));
  EXPECT_EQ(fractures[0].values[0].column, "opening");
  const auto refusal_of = [&](const std::string& geometry) -> std::string {
    try {
      read(geometry);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal_of(R"({"type": "LineString", "coordinates": [[1, 2], [2, 3]]})"),
              HasSubstr("a 'LineString' is no"));
  EXPECT_THAT(refusal_of(R"({"type": "Polygon", "coordinates": [[[1, 2], [2, 2], [1, 3], [1, 2]]]})"),
              HasSubstr("fewer than 3 coordinates"));
  EXPECT_THAT(refusal_of(R"({"type": "Polygon", "coordinates": [[[1, 2, 3]], [[1, 2, 3]]]})"),
              HasSubstr("has 2 rings"));
}

TEST(ScenesInSpace, RefuseKeysOfThePlane) {
  EXPECT_THAT(refusal(cube + "fractures: {f: {center: [2, 2, 2], length: 1 m, angle: 30 deg}}"),
              AllOf(HasSubstr("unknown key 'angle'"), HasSubstr("write strike")));
  EXPECT_THAT(refusal(cube + "regions: {r: {polygon: [[0, 0], [1, 0], [1, 1]]}}"),
              AllOf(HasSubstr("unknown key 'polygon'"), HasSubstr("between")));
  EXPECT_THAT(refusal(cube + "fractures: {f: {points: [[0, 0], [1, 1]]}}"), HasSubstr("2 coordinates"));
  EXPECT_THAT(refusal("box: {x: [0, 4], y: [0, 4]}"), HasSubstr("'z'"));
  EXPECT_THAT(refusal(cube + "fractures: {f: {center: [2, 2, 2], length: 1 m}}"), HasSubstr("is not given completely"));
  EXPECT_THAT(refusal(cube + "fractures: {f: {center: [2, 2, 2], radius: 1 m, length: 1 m, height: 2 m}}"),
              HasSubstr("is given twice"));
  EXPECT_THAT(refusal(cube + "fractures: {f: {center: [2, 2, 2], radius: [1 m, 2 m, 3 m]}}"),
              HasSubstr("'radius' has 3 values"));
  EXPECT_THAT(refusal(cube + "fractures: {f: {center: [2, 2, 2], radius: 1 m, dip: 120 deg}}"),
              AllOf(HasSubstr("'dip'"), HasSubstr("out of range")));
}

TEST(ScenesInSpace, GiveRegionsByBoxesHalfSpacesAndLayers) {
  const Geometry geometry = read_geometry(cube + R"(
regions:
  block: {box: {x: [1 m, 2 m], z: [0 m, 3 m]}}
  above: {point: [0, 0, 3], normal: [0, 0, 1]}
  layer: {between: [1 m, (2 + 0.1*x) m]}
  bent: {between: [1 m, (2 + 0.1*x^2) m]}
)");
  ASSERT_EQ(geometry.regions.size(), 4U);
  EXPECT_EQ(geometry.regions[0].half_spaces.size(), 4U);
  EXPECT_TRUE(is_inside({1.5, 9, 2}, geometry.regions[0]));
  EXPECT_FALSE(is_inside({1.5, 9, 3.5}, geometry.regions[0]));
  EXPECT_TRUE(is_inside({1.5, 9, 3.5}, geometry.regions[1]));
  EXPECT_EQ(geometry.regions[2].half_spaces.size(), 2U);
  EXPECT_TRUE(is_inside({3, 1, 2.2}, geometry.regions[2]));
  EXPECT_FALSE(is_inside({1, 1, 2.2}, geometry.regions[2]));
  EXPECT_EQ(geometry.regions[3].half_spaces.size(), 1U);
  EXPECT_TRUE(is_inside({3, 1, 2.8}, geometry.regions[3]));
  EXPECT_FALSE(is_inside({2, 1, 2.8}, geometry.regions[3]));
  EXPECT_THAT(refusal(cube + "regions: {r: {point: [0, 0, 1]}}"), HasSubstr("a half-space has a point and a normal"));
  EXPECT_THAT(refusal(cube + "regions: {r: {between: 3 m}}"), HasSubstr("a layer has a bottom and a top"));
  EXPECT_THAT(refusal(cube + "regions: {r: {}}"), HasSubstr("region 'r'"));
  // The mesh conforms to planes.
  Geometry layered = geometry;
  layered.regions = {geometry.regions[2]};
  const Mesh mesh = generate_mesh(layered, {.size = 1});
  EXPECT_NEAR(test::volume_of(mesh, 1), 16 * 1.2, 1e-9);
}

TEST(ScenesInSpace, GiveMeshes) {
  const auto read = [](const std::string& yaml) {
    MeshOptions options;
    mesh_spec(options).read(parse_yaml(yaml, "scene.yaml"), {});
    return options;
  };
  const MeshOptions options = read("{kind: structured, cells: [2, 3, 4], shape: wedges}");
  EXPECT_EQ(options.cells, (std::array<int, 3>{2, 3, 4}));
  EXPECT_EQ(options.shape, MeshOptions::Shape::wedges);
  EXPECT_EQ(read("{size: 1 m}").shape, MeshOptions::Shape::tetrahedra);
  EXPECT_THROW(read("{kind: structured, cells: [2, 3]}"), InputError);
  EXPECT_THROW(read("{shape: triangles}"), InputError);
}

class Files : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("sprekk_space_meshing_" + std::to_string(::getpid()));
};

class TablesInSpace : public Files {};

TEST_F(TablesInSpace, HoldPolygonsRectanglesAndDiscs) {
  write("polygons.csv",
        "name,x[m],y[m],z[cm],friction\na,1,1,100,0.6\na,2,1,100,0.6\na,2,2,100,0.6\nb,1,1,200,0.5\nb,2,1,200,0.5\nb,2,"
        "2,200,0.5\nb,1,2,200,0.5\n");
  Geometry geometry = read_geometry(cube + "fractures: {set: {table: polygons.csv}}", folder);
  ASSERT_EQ(geometry.fractures.size(), 2U);
  EXPECT_EQ(geometry.fractures[0].points, (std::vector<Point>{{1, 1, 1}, {2, 1, 1}, {2, 2, 1}}));
  EXPECT_EQ(geometry.fractures[1].values[0].value, 0.5);
  const std::string text = fracture_table(geometry.fractures);
  EXPECT_THAT(text, HasSubstr("name,x[m],y[m],z[m],friction\na,1,1,1,0.6\n"));
  write("rectangles.csv", "x,y,z,strike[deg],dip[deg],length,height\n2,2,2,0,30,2,1\n");
  geometry = read_geometry(cube + "fractures: {set: {table: rectangles.csv}}", folder);
  ASSERT_EQ(geometry.fractures.size(), 1U);
  EXPECT_EQ(geometry.fractures[0].name, "set_1");
  EXPECT_LT((FlatShape(geometry.fractures[0]).normal() - Point(0.5, 0, std::sqrt(0.75))).norm(), 1e-12);
  write("discs.csv", "name,x,y,z,strike[deg],dip[deg],radius[cm]\nround,2,2,2,90,45,50\n");
  geometry = read_geometry(cube + "fractures: {set: {table: discs.csv}}", folder);
  EXPECT_NEAR(geometry.fractures.at(0).ellipse->other_axis.norm(), 0.5, 1e-12);
  write("wrong.csv", "x,y,z,strike\n1,1,1,0\n");
  EXPECT_THAT(refusal(cube + "fractures: {set: {table: wrong.csv}}", folder), HasSubstr("lacks columns"));
  write("overturned.csv", "x,y,z,strike[deg],dip[deg],radius\n2,2,2,0,120,1\n");
  EXPECT_THAT(refusal(cube + "fractures: {set: {table: overturned.csv}}", folder),
              HasSubstr("is not from 0 to 90 degrees"));
}

TEST(RandomSetsInSpace, FollowFishersLawAndKeepApart) {
  const Geometry geometry = read_geometry(R"(
box: {x: [0, 100], y: [0, 100], z: [0, 100]}
fractures:
  joints:
    random:
      number: 50
      length: {law: power, exponent: 2.5, from: 10 m, to: 40 m}
      orientation: {strike: 40 deg, dip: 70 deg, concentration: 20}
      gap: 0.5 m
)");
  ASSERT_EQ(geometry.fractures.size(), 50U);
  Point sum = Point::Zero();
  const Point mean =
      FlatShape(read_geometry("box: {x: [0, 9], y: [0, 9], z: [0, 9]}\nfractures: {f: {center: [4, 4, 4], "
                              "strike: 40 deg, dip: 70 deg, length: 1 m, height: 1 m}}")
                    .fractures[0])
          .normal();
  for (const FractureGeometry& fracture : geometry.fractures) {
    const Point normal = FlatShape(fracture).normal();
    sum += normal.dot(mean) < 0 ? Point(-normal) : normal;
    for (const Point& point : fracture.points) {
      EXPECT_GE(point.minCoeff(), 0.5);
      EXPECT_LE(point.maxCoeff(), 99.5);
    }
  }
  // The mean of the cosines is coth(kappa) - 1/kappa; its deviation with 50 normals is below 0.01.
  EXPECT_NEAR(sum.dot(mean) / 50, 1 - 1.0 / 20, 0.03);
  const Mesh mesh = generate_mesh(geometry, {.size = 12, .fracture_size = 4});
  EXPECT_EQ(mesh.fractures.size(), 50U);
  for (int f = 0; f < 50; ++f) {
    const double whole = FlatShape(geometry.fractures[f]).area();
    EXPECT_NEAR(test::area_of(mesh, f), whole, 1e-8 * whole) << f;
  }
  EXPECT_GT(mesh.junctions.size(), 0U);
  EXPECT_GT(mesh_quality(mesh).smallest_angle, 5 * pi / 180);
}

class MeshFilesInSpace : public Files {
 protected:
  std::string refusal_of(const std::string& text) const {
    write("mesh.msh", text);
    try {
      Geometry geometry;
      geometry.file = folder / "mesh.msh";
      generate_mesh(geometry, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  Mesh mesh_of(const std::string& text) const {
    write("mesh.msh", text);
    Geometry geometry;
    geometry.file = folder / "mesh.msh";
    return generate_mesh(geometry, {});
  }
};

/// Two hexahedra, of which one is cut into two wedges, on either side of a fracture.
const std::string old_format = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
2 1 "foot"
2 2 "fault"
3 3 "west"
3 4 "east"
$EndPhysicalNames
$Nodes
12
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
7 0 0 1
8 1 0 1
9 2 0 1
10 0 1 1
11 1 1 1
12 2 1 1
$EndNodes
$Elements
7
1 3 2 1 1 1 2 5 4
2 2 2 1 1 2 3 6
3 2 2 1 1 2 6 5
4 3 2 2 2 2 5 11 8
5 5 2 3 3 1 2 5 4 7 8 11 10
6 6 2 4 4 2 3 6 8 9 12
7 6 2 4 4 2 6 5 8 12 11
$EndElements
)";

TEST_F(MeshFilesInSpace, OfVersion22) {
  const Mesh mesh = mesh_of(old_format);
  EXPECT_EQ(mesh.cell_count(), 3);
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"west", "east"}));
  EXPECT_EQ(mesh.side_names, (std::vector<std::string>{"foot", "boundary"}));
  ASSERT_EQ(mesh.fractures.size(), 1U);
  EXPECT_EQ(mesh.fractures[0].name, "fault");
  EXPECT_EQ(mesh.fracture_cell_count(), 1);
  EXPECT_NEAR(mesh.fracture_cells[0].normal.x(), 1, 1e-15);
  double volume = 0;
  for (const double measure : mesh.cell_measure) volume += measure;
  EXPECT_NEAR(volume, 2, 1e-15);
}

TEST_F(MeshFilesInSpace, OfVersion41) {
  const Mesh mesh = mesh_of(R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "foot"
3 3 "rock"
$EndPhysicalNames
$Entities
0 0 1 1
1 0 0 0 1 1 0 1 1 0
1 0 0 0 1 1 1 1 3 0
$EndEntities
$Nodes
1 4 1 4
3 1 0 4
1
2
3
4
0 0 0
1 0 0
0 1 0
0 0 1
$EndNodes
$Elements
2 2 1 2
2 1 2 1
1 1 2 3
3 1 4 1
2 1 2 3 4
$EndElements
)");
  EXPECT_EQ(mesh.cell_count(), 1);
  EXPECT_NEAR(mesh.cell_measure[0], 1.0 / 6, 1e-15);
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"rock"}));
  EXPECT_EQ(mesh.side_names, (std::vector<std::string>{"foot", "boundary"}));
}

TEST_F(MeshFilesInSpace, ThatDoNotFitAreRefused) {
  const auto replaced = [](std::string text, const std::string& what, const std::string& by) {
    return text.replace(text.find(what), what.size(), by);
  };
  EXPECT_THAT(refusal_of(replaced(old_format, "4 3 2 2 2 2 5 11 8", "4 3 2 2 2 1 5 11 8")),
              HasSubstr("surface 'fault' leaves the faces of the cells"));
  EXPECT_THAT(refusal_of(replaced(old_format, "5 5 2 3 3 1 2 5 4 7 8 11 10", "5 7 2 3 3 1 2 5 4 7")),
              AllOf(HasSubstr("gmsh type 7"), HasSubstr("without pyramids")));
  // The two bodies with nodes of their own.
  std::string apart = replaced(old_format, "$Nodes\n12\n", "$Nodes\n16\n13 1 0 0\n14 1 1 0\n15 1 0 1\n16 1 1 1\n");
  apart = replaced(apart, "5 5 2 3 3 1 2 5 4 7 8 11 10", "5 5 2 3 3 1 13 14 4 7 15 16 10");
  apart = replaced(apart, "1 3 2 1 1 1 2 5 4\n", "1 3 2 1 1 1 13 14 4\n");
  EXPECT_THAT(refusal_of(apart), HasSubstr("its cells do not fit together: 8 nodes lie on outer faces of other cells"));
}

}  // namespace
}  // namespace sprekk
