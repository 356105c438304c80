#include "framework/mesh/read_msh.hpp"

#include <gmsh.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/generate_mesh.hpp"
#include "framework/mesh/gmsh_model.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A file that is removed at the end.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text = "") {
    static int count = 0;
    path_ = testing::TempDir() + "sprekk_read_msh_" + testing::UnitTest::GetInstance()->current_test_info()->name() +
            std::to_string(count++) + ".msh";
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

struct Line {
  int group, a, b;
};

/// MSH 2.2, written by hand: 16 nodes at (i, j), node number 1 + i + 4 j; 18 triangles, the upper third in group 21.
/// Group 1 is the bottom, groups 11 and up are what the test gives.
std::string three_by_three(const std::vector<Line>& lines, int triangle_type = 2) {
  std::ostringstream out;
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n1 1 \"bottom\"\n1 11 \"crack\"\n1 12 \"vein\"\n"
         "2 20 \"sand\"\n2 21 \"clay\"\n$EndPhysicalNames\n$Nodes\n16\n";
  for (int n = 0; n < 16; ++n) out << n + 1 << ' ' << n % 4 << ' ' << n / 4 << " 0\n";
  out << "$EndNodes\n$Elements\n" << 3 + lines.size() + 18 << '\n';
  int element = 1;
  for (int i = 1; i <= 3; ++i) out << element++ << " 1 2 1 1 " << i << ' ' << i + 1 << '\n';
  for (const auto& [group, a, b] : lines) {
    out << element++ << " 1 2 " << group << ' ' << group << ' ' << a << ' ' << b << '\n';
  }
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      const int a = 1 + i + 4 * j, region = j == 2 ? 21 : 20;
      const std::string head =
          ' ' + std::to_string(triangle_type) + " 2 " + std::to_string(region) + ' ' + std::to_string(region) + ' ';
      out << element++ << head << a << ' ' << a + 1 << ' ' << a + 5 << '\n';
      out << element++ << head << a << ' ' << a + 5 << ' ' << a + 4 << '\n';
    }
  }
  out << "$EndElements\n";
  return out.str();
}

std::string refusal(const std::string& text) {
  const TemporaryFile file(text);
  return input_error([&] { read_msh(file.path(), {"scene.yaml", 3, 9}); });
}

TEST(ReadMsh, ReadsRegionsSidesAndFractures) {
  // The crack's lines are neither in order nor all in one direction; the first one directs it.
  const TemporaryFile file(three_by_three({{11, 7, 6}, {11, 11, 7}, {11, 5, 6}}));
  const RawMesh raw = read_msh(file.path());
  EXPECT_EQ(raw.region_names, (std::vector<std::string>{"sand", "clay"}));
  EXPECT_EQ(raw.side_names, (std::vector<std::string>{"bottom", "boundary"}));
  const Mesh mesh = build_mesh(raw);
  expect_consistent(mesh);
  EXPECT_EQ(mesh.cell_count(), 18);
  ASSERT_EQ(mesh.fractures.size(), 1u);
  EXPECT_EQ(mesh.fractures[0].name, "crack");
  ASSERT_EQ(mesh.fractures[0].cell_count, 3);
  EXPECT_EQ(mesh.fracture_points[0].position, Point(2, 2));
  EXPECT_EQ(mesh.fracture_points[3].position, Point(0, 1));
  EXPECT_EQ(mesh.fracture_points[3].kind, FracturePoint::Kind::on_boundary);
  EXPECT_EQ(mesh.side_names[mesh.fracture_points[3].side], "boundary");
  double clay = 0, bottom = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) clay += mesh.cell_region[c] == 1 ? mesh.cell_area[c] : 0;
  for (int f = 0; f < mesh.face_count(); ++f) bottom += mesh.face_side[f] == 0 ? mesh.face_length[f] : 0;
  EXPECT_NEAR(clay, 3, 1e-14);
  EXPECT_NEAR(bottom, 3, 1e-14);
}

TEST(ReadMsh, NamesAreKnownBeforeMeshing) {
  const TemporaryFile file(three_by_three({{11, 6, 7}, {12, 10, 11}}));
  Geometry geometry;
  geometry.file = file.path();
  const MeshNames names = mesh_names(geometry);
  EXPECT_EQ(names.regions, (std::vector<std::string>{"sand", "clay"}));
  EXPECT_EQ(names.sides, (std::vector<std::string>{"bottom", "boundary"}));
  EXPECT_EQ(names.fractures, (std::vector<std::string>{"crack", "vein"}));
  const Mesh mesh = generate_mesh(geometry, {});
  expect_consistent(mesh);
  EXPECT_EQ(mesh.fracture_cell_count(), 2);
  EXPECT_NEAR(total_area(mesh), 9, 1e-13);
}

TEST(ReadMsh, ReadsWhatGmshWritesInEveryVersion) {
  struct Format {
    double version;
    int binary;
  };
  for (const auto& [version, binary] : {Format{2.2, 0}, {2.2, 1}, {4.0, 0}, {4.1, 0}, {4.1, 1}}) {
    const TemporaryFile file;
    {
      const GmshModel model;
      model.run("write a file", [&] {
        for (const auto& [x, y] : {std::pair(0, 0), {2, 0}, {2, 1}, {0, 1}}) gmsh::model::geo::addPoint(x, y, 0, 0.2);
        const int from = gmsh::model::geo::addPoint(0.5, 0.5, 0, 0.2),
                  to = gmsh::model::geo::addPoint(1.5, 0.5, 0, 0.2);
        for (int i = 0; i < 4; ++i) gmsh::model::geo::addLine(1 + i, 1 + (i + 1) % 4);
        const int crack = gmsh::model::geo::addLine(from, to);
        gmsh::model::geo::addCurveLoop({1, 2, 3, 4}, 1);
        gmsh::model::geo::addPlaneSurface({1}, 1);
        gmsh::model::geo::synchronize();
        gmsh::model::mesh::embed(1, {crack}, 2, 1);
        const auto name = [](int dim, const std::vector<int>& tags, const std::string& words) {
          gmsh::model::setPhysicalName(dim, gmsh::model::addPhysicalGroup(dim, tags), words);
        };
        name(1, {1, 3}, "bottom and top");
        name(1, {2, 4}, "left and right");
        name(1, {crack}, "crack");
        name(2, {1}, "granite");
        gmsh::option::setNumber("Mesh.MeshSizeMax", 0.2);
        gmsh::model::mesh::generate(2);
        gmsh::option::setNumber("Mesh.MeshSizeMax", 1e22);
        gmsh::option::setNumber("Mesh.MshFileVersion", version);
        gmsh::option::setNumber("Mesh.Binary", binary);
        gmsh::write(file.path());
      });
    }
    Geometry geometry;
    geometry.file = file.path();
    const Mesh mesh = generate_mesh(geometry, {});
    expect_consistent(mesh);
    EXPECT_EQ(mesh.region_names, std::vector<std::string>{"granite"});
    EXPECT_EQ(mesh.side_names, (std::vector<std::string>{"bottom and top", "left and right"}));
    EXPECT_NEAR(total_area(mesh), 2, 1e-13);
    EXPECT_NEAR(fracture_length(mesh, 0), 1, 1e-14);
    EXPECT_EQ(euler_characteristic(mesh), 0);
  }
}

TEST(ReadMsh, RefusesFracturesThatAreNoSingleLine) {
  EXPECT_THAT(refusal(three_by_three({{11, 5, 6}, {11, 6, 7}, {11, 6, 10}})),
              AllOf(HasSubstr("scene.yaml:3:9"), HasSubstr("fracture 'crack' branches")));
  EXPECT_THAT(refusal(three_by_three({{11, 6, 7}, {11, 7, 11}, {11, 11, 6}})),
              HasSubstr("fracture 'crack' is a closed loop"));
  EXPECT_THAT(refusal(three_by_three({{11, 6, 7}, {11, 10, 11}})), HasSubstr("fracture 'crack' is in several parts"));
  EXPECT_THAT(refusal(three_by_three({{11, 5, 1}, {11, 5, 6}})), HasSubstr("partly inside and partly on the boundary"));
  EXPECT_THAT(refusal(three_by_three({{11, 6, 16}})), HasSubstr("curve 'crack' leaves the edges of the cells"));
}

TEST(ReadMsh, FracturesMayMeet) {
  const TemporaryFile file(three_by_three({{11, 5, 6}, {11, 6, 7}, {12, 6, 10}}));
  Geometry geometry;
  geometry.file = file.path();
  const Mesh mesh = generate_mesh(geometry, {});
  expect_consistent(mesh);
  ASSERT_EQ(mesh.junctions.size(), 1u);
  EXPECT_EQ(mesh.junctions[0].cells.size(), 3u);
}

TEST(ReadMsh, FracturesThatMeetOnTheBoundaryAreRefusedWithTheFilesName) {
  const TemporaryFile file(three_by_three({{11, 5, 6}, {12, 5, 10}}));
  Geometry geometry;
  geometry.file = file.path();
  geometry.file_origin = {"scene.yaml", 3, 9};
  EXPECT_THAT(
      input_error([&] { generate_mesh(geometry, {}); }),
      AllOf(HasSubstr("scene.yaml:3:9"), HasSubstr(file.path()), HasSubstr("'crack' and 'vein' meet at (0, 1)")));
}

TEST(ReadMsh, ReadsTrianglesBesideQuadrilaterals) {
  // Two squares, the second of them cut in two; a crack along the face between the first and the others.
  const std::string head =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 11 \"crack\"\n2 20 \"sand\"\n2 21 \"clay\"\n"
      "$EndPhysicalNames\n$Nodes\n9\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n7 0 2 0\n8 1 2 0\n9 2 2 0\n"
      "$EndNodes\n$Elements\n6\n1 1 2 11 11 2 5\n";
  const TemporaryFile file(head +
                           "2 3 2 20 20 1 2 5 4\n3 2 2 21 21 2 3 6\n4 2 2 21 21 2 6 5\n5 3 2 21 21 4 7 8 5\n"
                           "6 3 2 21 21 5 6 9 8\n$EndElements\n");
  const Mesh mesh = build_mesh(read_msh(file.path()));
  expect_consistent(mesh);
  ASSERT_EQ(mesh.cell_count(), 5);
  int quadrilaterals = 0;
  for (const Ring& cell : mesh.cell_nodes) quadrilaterals += cell.size() == 4 ? 1 : 0;
  EXPECT_EQ(quadrilaterals, 3);
  EXPECT_NEAR(total_area(mesh), 4, 1e-14);
  EXPECT_EQ(std::count(mesh.cell_region.begin(), mesh.cell_region.end(), 0), 1);
  EXPECT_EQ(mesh.fracture_cell_count(), 1);
  // The same with an arrowhead: the node in the middle is moved over the diagonal of the first square.
  std::string moved = head;
  moved.replace(moved.find("5 1 1 0"), 7, "5 0.4 0.4 0");
  const TemporaryFile bad(moved +
                          "2 3 2 20 20 1 2 5 4\n3 2 2 21 21 2 3 6\n4 2 2 21 21 2 6 5\n5 3 2 21 21 4 7 8 5\n"
                          "6 3 2 21 21 5 6 9 8\n$EndElements\n");
  Geometry geometry;
  geometry.file = bad.path();
  geometry.file_origin = {"scene.yaml", 3, 9};
  EXPECT_THAT(input_error([&] { generate_mesh(geometry, {}); }),
              AllOf(HasSubstr("scene.yaml:3:9"), HasSubstr(bad.path()), HasSubstr("is not convex")));
  geometry.file = file.path();
  EXPECT_THAT(input_error([&] { generate_mesh(geometry, {.shape = MeshOptions::Shape::quadrilaterals}); }),
              HasSubstr("keep their shape"));
}

TEST(ReadMsh, RefusesWhatIsNoPlaneMeshOfTrianglesAndQuadrilaterals) {
  EXPECT_THAT(input_error([] { read_msh("no_such_file.msh"); }), HasSubstr("does not exist"));
  EXPECT_THAT(refusal("this is no mesh\n"), HasSubstr("cannot use the mesh file"));
  EXPECT_THAT(refusal(""), HasSubstr("cannot use the mesh file"));
  EXPECT_THAT(refusal("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.5 0 0\n5 0.5 "
                      "0.5 0\n6 0 0.5 0\n"
                      "$EndNodes\n$Elements\n1\n1 9 2 1 1 1 2 3 4 5 6\n$EndElements\n"),
              HasSubstr("elements that are no three-node triangles or four-node quadrilaterals"));
  EXPECT_THAT(refusal("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 1 1 1\n$EndNodes\n"
                      "$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n"),
              HasSubstr("leaves the x-y plane"));
}

}  // namespace
}  // namespace sprekk::test
