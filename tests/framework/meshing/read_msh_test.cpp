#include "framework/meshing/read_msh.hpp"

#include <gmsh.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "framework/mesh/build_mesh.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "framework/meshing/gmsh_module/gmsh_model.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"
#include "tests/framework/meshing/mutated_meshes.hpp"

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
  EXPECT_EQ(mesh.ridges[0].center, Point(2, 2));
  EXPECT_EQ(mesh.ridges[3].center, Point(0, 1));
  EXPECT_EQ(mesh.ridges[3].kind, Ridge::Kind::on_boundary);
  EXPECT_EQ(mesh.side_names[mesh.ridges[3].side], "boundary");
  double clay = 0, bottom = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) clay += mesh.cell_region[c] == 1 ? mesh.cell_measure[c] : 0;
  for (int f = 0; f < mesh.face_count(); ++f) bottom += mesh.face_side[f] == 0 ? mesh.face_measure[f] : 0;
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

TEST(ReadMsh, ReadsWhatGmshWritesInBothVersions) {
  struct Format {
    double version;
    int binary;
  };
  for (const auto& [version, binary] : {Format{2.2, 0}, {2.2, 1}, {4.1, 0}, {4.1, 1}}) {
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

/// `text` with the first `old` behind `mark` replaced.
std::string changed(std::string text, const std::string& mark, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old, text.find(mark));
  return text.replace(at, old.size(), by);
}

TEST(ReadMsh, RunsNoCommandsOfAFile) {
  const std::string made = testing::TempDir() + "sprekk_made_by_a_mesh_file";
  const std::string command = "SystemCall \"touch " + made + "\";\n";
  for (const std::string& text :
       {command, "// a mesh\n" + command, "\n" + command, "$Comments\n$EndComments\n" + command,
        three_by_three({{11, 6, 7}}) + command, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + command}) {
    EXPECT_THAT(refusal(text), AllOf(HasSubstr("scene.yaml:3:9: cannot use the mesh file"), HasSubstr("line ")));
    EXPECT_FALSE(std::filesystem::exists(made)) << text;
    std::filesystem::remove(made);
  }
  EXPECT_THAT(refusal(command), HasSubstr("line 1: the file is no mesh: it does not begin with $MeshFormat"));
}

TEST(ReadMsh, SaysOnWhichLineAFileIsWrong) {
  const std::string text = three_by_three({{11, 6, 7}});
  // Line 14 is the first node, line 32 the number of elements, line 33 the first line, line 37 the first triangle.
  EXPECT_THAT(refusal(changed(text, "$Nodes", "16", "17")), HasSubstr("line 30: '$EndNodes' stands where"));
  EXPECT_THAT(refusal(changed(text, "$Nodes", "16", "15")), HasSubstr("line 29: '16 3 3 0' stands where $EndNodes"));
  EXPECT_THAT(refusal(changed(text, "$Nodes", "16", "2000000000")), HasSubstr("more than the rest of the file"));
  EXPECT_THAT(refusal(changed(text, "$Nodes", "16", "-1")), HasSubstr("line 13: the number of nodes is -1"));
  EXPECT_THAT(refusal(changed(text, "$Nodes", "2 1 0", "1 1 0")), HasSubstr("line 15: node 1 is there twice"));
  EXPECT_THAT(refusal(changed(text, "$Nodes", "2 1 0", "2 nan 0")), HasSubstr("line 15: 'nan' is no finite number"));
  EXPECT_THAT(refusal(changed(text, "$Nodes", "2 1 0", "2 1e13 0")), HasSubstr("line 15: node 2 is farther than"));
  EXPECT_THAT(refusal(changed(text, "$Nodes", "2 1 0", "2 1,5 0")), HasSubstr("line 15: '1,5' stands where a coord"));
  EXPECT_THAT(refusal(changed(text, "$Elements", "20 20 1 2 6", "20 20 1 2 77")),
              HasSubstr("line 37: an element names node 77, which the file does not hold"));
  EXPECT_THAT(refusal(changed(text, "$Elements", "20 20 1 2 6", "20 20 1 2 2")),
              AllOf(HasSubstr("line 37: "), HasSubstr("is degenerate")));
  EXPECT_THAT(refusal(changed(text, "$Elements", "20 20 1 6 5", "21 20 1 2 6")),
              HasSubstr("line 38: a cell is there twice, before at line 37"));
  EXPECT_THAT(refusal(changed(text, "$PhysicalNames", "\"clay\"", "\"sand\"")),
              HasSubstr("two regions are called 'sand'"));
  EXPECT_THAT(refusal(changed(text, "$PhysicalNames", "\"bottom\"", "\"boundary\"")),
              HasSubstr("two sides are called 'boundary'"));
  EXPECT_THAT(refusal(text.substr(0, text.find("$EndNodes") - 4)), HasSubstr("line 29: the file ends where a coord"));
  EXPECT_THAT(refusal(text.substr(0, text.find("$Elements"))), HasSubstr("has no section $Elements"));
  EXPECT_THAT(refusal(text + "$Nodes\n0\n$EndNodes\n"), HasSubstr("the section $Nodes is there twice"));
  EXPECT_THAT(refusal(text + "$NodeData\n1\n"), HasSubstr("the section '$NodeData' does not end"));
  for (const std::string version : {"1", "2", "4", "4.0", "5"}) {
    EXPECT_THAT(refusal(changed(text, "$MeshFormat", "2.2", version)),
                AllOf(HasSubstr("line 2: the format's version is '" + version + "'"),
                      HasSubstr("gmsh FILE -save -format msh41 -o NEW.msh")));
  }
  EXPECT_THAT(input_error([] { read_msh("/dev/zero"); }), HasSubstr("it is no file"));
  EXPECT_THAT(input_error([] { read_msh(testing::TempDir()); }), HasSubstr("it is no file"));
}

TEST(ReadMsh, LeavesOutWhatItDoesNotNeed) {
  std::string text = three_by_three({{11, 6, 7}});
  text = changed(text, "$Nodes", "$EndNodes", "4000000000 0.3 0.3 0\n$EndNodes");
  text = changed(text, "$Nodes", "16", "17");
  text = changed(text, "$Nodes", "4000000000", "2000000000");
  text = "$Comments\nby hand\n$EndComments\n" + text + "$NodeData\n1\n\"p\"\n$EndNodeData\n";
  std::string windows;
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& one : {text, windows}) {
    const TemporaryFile file(one);
    const Mesh mesh = build_mesh(read_msh(file.path()));
    expect_consistent(mesh);
    EXPECT_EQ(mesh.node_count(), 16);
    EXPECT_EQ(mesh.fracture_cell_count(), 1);
    EXPECT_NEAR(total_area(mesh), 9, 1e-13);
  }
}

TEST(ReadMsh, ReadsEntitiesOfVersion41) {
  // Two unit squares, in blocks that are not in order, numbers with gaps, an entity with a negative group, parameters.
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 7 \"base\"\n2 9 \"sand\"\n$EndPhysicalNames\n"
      "$Entities\n1 1 2 0\n5 0 0 0 0\n3 0 0 0 2 0 0 1 -7 2 5 -5\n1 0 0 0 1 1 0 1 9 0\n2 1 0 0 2 1 0 0 0\n"
      "$EndEntities\n$Nodes\n3 6 10 900\n2 1 0 2\n900\n20\n1 1 0\n0 1 0\n1 3 1 2\n10\n11\n0 0 0 0.5\n"
      "1 0 0 1\n2 2 1 2\n400\n12\n2 1 0 0.1 0.2\n2 0 0 0.3 0.4\n$EndNodes\n$Elements\n3 4 1 9\n2 2 3 1\n"
      "9 11 12 400 900\n1 3 1 2\n1 10 11\n2 11 12\n2 1 3 1\n4 10 11 900 20\n$EndElements\n";
  const TemporaryFile file(text);
  const Mesh mesh = build_mesh(read_msh(file.path()));
  expect_consistent(mesh);
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"sand", "medium"}));
  EXPECT_EQ(mesh.side_names, (std::vector<std::string>{"base", "boundary"}));
  EXPECT_NEAR(total_area(mesh), 2, 1e-15);
  EXPECT_THAT(refusal(changed(text, "$Elements", "2 2 3 1", "2 8 3 1")),
              HasSubstr("entity 8 of dimension 2 is not among the $Entities"));
  EXPECT_THAT(refusal(changed(text, "$Elements", "2 2 3 1", "1 3 3 1")), HasSubstr("belong to an entity of dimension"));
  EXPECT_THAT(refusal(changed(text, "$Entities", "0 1 9 0", "0 2 9 8 0")), HasSubstr("belongs to two groups"));
  EXPECT_THAT(refusal(changed(text, "$Elements", "9 11 12 400 900", "9 11 12 18446744073709551615 900")),
              HasSubstr("names node 18446744073709551615"));
}

TEST(ReadMsh, ReadsPartitions) {
  // Two unit squares, one in each partition; the entities of partitions have the groups.
  const TemporaryFile file(
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 9 \"sand\"\n$EndPhysicalNames\n"
      "$Entities\n0 0 1 0\n1 0 0 0 2 1 0 1 9 0\n$EndEntities\n$PartitionedEntities\n2\n0\n0 0 2 0\n"
      "2 2 1 1 1 0 0 0 1 1 0 1 9 0\n3 2 1 1 2 1 0 0 2 1 0 1 9 0\n$EndPartitionedEntities\n"
      "$Nodes\n1 6 1 6\n2 2 0 6\n1\n2\n3\n4\n5\n6\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n$EndNodes\n"
      "$Elements\n2 2 1 2\n2 2 3 1\n1 1 2 5 4\n2 3 3 1\n2 2 3 6 5\n$EndElements\n");
  const Mesh mesh = build_mesh(read_msh(file.path()));
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"sand"});
  EXPECT_NEAR(total_area(mesh), 2, 1e-15);
}

/// Area times distance from the origin squared, summed over cells: differs between meshes of the same rectangle.
double moment(const Mesh& mesh) {
  double sum = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) sum += mesh.cell_measure[c] * mesh.cell_center[c].squaredNorm();
  return sum;
}

TEST(ReadMsh, AllFormatsGiveOneMesh) {
  // What gmsh writes of a mesh in each format; 32 squares have a known moment.
  double expected = 0, of_triangles = 0;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 4; ++j) expected += Point(0.125 + 0.25 * i, 0.125 + 0.25 * j).squaredNorm() / 16;
  }
  for (const std::string& bytes : meshes_of_gmsh()) {
    const TemporaryFile file(bytes);
    const Mesh mesh = build_mesh(read_msh(file.path()));
    expect_consistent(mesh);
    EXPECT_EQ(mesh.region_names, std::vector<std::string>{"granite"});
    EXPECT_EQ(mesh.side_names, (std::vector<std::string>{"bottom and top", "boundary"}));
    EXPECT_NEAR(total_area(mesh), 2, 1e-13);
    if (mesh.fractures.size() == 1) {
      EXPECT_EQ(mesh.cell_count(), 32);
      EXPECT_NEAR(fracture_length(mesh, 0), 1, 1e-14);
      EXPECT_NEAR(moment(mesh), expected, 1e-12);
    } else {
      ASSERT_EQ(mesh.fractures.size(), 2u);
      EXPECT_NEAR(fracture_length(mesh, 0), 1.2, 1e-14);
      EXPECT_NEAR(fracture_length(mesh, 1), std::hypot(0.6, 0.5), 1e-14);
      if (of_triangles == 0) of_triangles = moment(mesh);
      EXPECT_NEAR(moment(mesh), of_triangles, 1e-12);
    }
  }
}

/// tools/stress --meshes reads 2,000 under the sanitizers.
TEST(ReadMsh, ReadsOrRefusesFilesWithMistakes) {
  const std::vector<std::string> meshes = meshes_of_gmsh();
  int refused = 0;
  for (unsigned number = 0; number < 300; ++number) {
    std::mt19937 random(number);
    const TemporaryFile file(mutated(meshes[number % meshes.size()], random));
    EXPECT_EQ(failure_of_reading(file.path()), "") << "file " << number;
    try {
      read_msh(file.path());
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 150);
}

}  // namespace
}  // namespace sprekk::test
