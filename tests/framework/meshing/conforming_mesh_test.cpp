// Mesh files whose cells do not fit together are refused with the places.
#include <gmsh.h>

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>

#include "framework/mesh/build_mesh.hpp"
#include "framework/meshing/gmsh_module/gmsh_model.hpp"
#include "framework/meshing/read_msh.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// Cells as a file of version 2.2 in a unit, turned by an angle.
struct Cells {
  std::vector<Point> nodes;
  std::vector<std::vector<int>> cells;         ///< numbers of nodes from 0
  std::vector<std::array<int, 3>> lines = {};  ///< group, two nodes
  std::vector<std::string> groups = {};        ///< of lines, from 1

  int add_node(double x, double y) {
    nodes.emplace_back(x, y);
    return static_cast<int>(nodes.size()) - 1;
  }

  /// Triangles of nx by ny rectangles, with nodes of their own.
  void add_grid(const Point& low, const Point& high, int nx, int ny) {
    const int first = static_cast<int>(nodes.size());
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        add_node(low.x() + (high.x() - low.x()) * i / nx, low.y() + (high.y() - low.y()) * j / ny);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int a = first + i + (nx + 1) * j;
        cells.push_back({a, a + 1, a + nx + 2});
        cells.push_back({a, a + nx + 2, a + nx + 1});
      }
  }

  RawMesh read(std::vector<std::string>* notes = nullptr, double angle = 0) const {
    const std::string file = testing::TempDir() + "sprekk_conforming_mesh_" + std::to_string(getpid()) + ".msh";
    std::ofstream out(file);
    out.precision(17);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << groups.size() << '\n';
    for (std::size_t g = 0; g < groups.size(); ++g) out << "1 " << g + 1 << " \"" << groups[g] << "\"\n";
    out << "$EndPhysicalNames\n$Nodes\n" << nodes.size() << '\n';
    for (std::size_t n = 0; n < nodes.size(); ++n)
      out << n + 1 << ' ' << std::cos(angle) * nodes[n].x() - std::sin(angle) * nodes[n].y() << ' '
          << std::sin(angle) * nodes[n].x() + std::cos(angle) * nodes[n].y() << " 0\n";
    out << "$EndNodes\n$Elements\n" << lines.size() + cells.size() << '\n';
    int element = 1;
    for (const auto& [group, a, b] : lines)
      out << element++ << " 1 2 " << group << ' ' << group << ' ' << a + 1 << ' ' << b + 1 << '\n';
    for (const std::vector<int>& cell : cells) {
      out << element++ << (cell.size() == 3 ? " 2" : " 3") << " 2 0 1";
      for (const int node : cell) out << ' ' << node + 1;
      out << '\n';
    }
    out << "$EndElements\n";
    out.close();
    return read_msh(file, {"scene.yaml", 3, 9}, notes);
  }

  std::string refusal(double angle = 0) const {
    return input_error([&] { read(nullptr, angle); });
  }
};

Cells unit_square(int nx = 8, int ny = 8) {
  Cells square;
  square.add_grid({0, 0}, {1, 1}, nx, ny);
  return square;
}

TEST(ConformingMesh, PartsWithTheirOwnNodesAreRefused) {
  Cells halves;
  halves.add_grid({0, 0}, {1, 0.5}, 8, 4);
  halves.add_grid({0, 0.5}, {1, 1}, 8, 4);
  EXPECT_THAT(halves.refusal(), AllOf(HasSubstr("scene.yaml:3:9"), HasSubstr("8 pairs of edges lie on one another"),
                                      HasSubstr("(0.0625, 0.5), (0.1875, 0.5), (0.3125, 0.5), …")));
  EXPECT_THAT(halves.refusal(0.7), HasSubstr("8 pairs of edges lie on one another"));
  for (Point& node : halves.nodes) node *= 1 + 1e-9 * std::sin(1e4 * node.x() + 3e4 * node.y());
  EXPECT_THAT(halves.refusal(), HasSubstr("8 pairs of edges lie on one another"));
}

TEST(ConformingMesh, NodesOnEdgesAreRefused) {
  // Common nodes where both parts have some: one edge of the lower part is two of the upper one.
  Cells cells;
  const int a = cells.add_node(0, 0), b = cells.add_node(1, 0), c = cells.add_node(1, 1), d = cells.add_node(0, 1);
  const int hanging = cells.add_node(0.5, 1), e = cells.add_node(1, 2), f = cells.add_node(0, 2);
  cells.cells = {{a, b, c, d}, {d, hanging, f}, {hanging, c, e}, {hanging, e, f}};
  EXPECT_THAT(cells.refusal(), AllOf(HasSubstr("1 node lies on the inside of an edge, at (0.5, 1)")));
  for (const double angle : {0.3, 2.0}) EXPECT_THAT(cells.refusal(angle), HasSubstr("1 node lies on the inside"));
  // Two grids of which one is twice as fine.
  Cells grids;
  grids.add_grid({0, 0}, {1, 0.5}, 4, 2);
  grids.add_grid({0, 0.5}, {1, 1}, 8, 4);
  EXPECT_THAT(grids.refusal(), HasSubstr("4 nodes lie on the inside of an edge, at (0.125, 0.5)"));
}

TEST(ConformingMesh, GapsAndOverlapsAreRefused) {
  for (const double width : {1e-4, 1e-6, -1e-6, -1e-4}) {
    Cells cells;
    cells.add_grid({0, 0}, {1, 0.5}, 8, 4);
    cells.add_grid({0, 0.5 + width}, {1, 1}, 8, 4);
    const std::string what = width > 0 ? "nodes have a gap to the cells beside them" : "cells that overlap";
    EXPECT_THAT(cells.refusal(), HasSubstr(what)) << width;
    EXPECT_THAT(cells.refusal(1.1), HasSubstr(what)) << width;
  }
  // One part covers half of another one, with nodes on its sides.
  Cells covered;
  covered.add_grid({0, 0}, {1, 0.5}, 8, 4);
  covered.add_grid({0, 0.3}, {1, 1}, 8, 4);
  EXPECT_THAT(covered.refusal(), HasSubstr("nodes lie on the inside of an edge"));
  // One reaches into another one.
  Cells crossing;
  crossing.add_grid({0, 0}, {1, 0.5}, 8, 4);
  crossing.add_grid({0.21, 0.31}, {0.72, 1}, 8, 4);
  EXPECT_THAT(crossing.refusal(), HasSubstr("2 places have cells that overlap, at (0.21, 0.5), (0.72, 0.5)"));
  // One part lies wholly on another one.
  Cells on_top = unit_square();
  on_top.add_grid({0.31, 0.32}, {0.61, 0.63}, 3, 3);
  EXPECT_THAT(on_top.refusal(), HasSubstr("1 place has cells that overlap"));
}

TEST(ConformingMesh, MissingCellsAreRefused) {
  for (const auto& [first, count, edges] : {std::tuple(40, 1, 3), {40, 2, 4}, {40, 6, 8}}) {
    Cells square = unit_square();
    const int nodes = static_cast<int>(square.nodes.size());
    square.cells.erase(square.cells.begin() + first, square.cells.begin() + first + count);
    EXPECT_THAT(square.refusal(), HasSubstr("cells are missing: 1 hole of few edges")) << edges;
    EXPECT_EQ(static_cast<int>(square.nodes.size()), nodes);
  }
  // A hole that is meant has a group.
  Cells square = unit_square();
  square.cells.erase(square.cells.begin() + 40, square.cells.begin() + 42);
  const int corner = 9 * 2 + 4;
  square.groups = {"well"};
  square.lines = {
      {1, corner, corner + 1}, {1, corner + 1, corner + 10}, {1, corner + 10, corner + 9}, {1, corner + 9, corner}};
  std::vector<std::string> notes;
  const RawMesh raw = square.read(&notes);
  EXPECT_EQ(raw.side_names, (std::vector<std::string>{"well", "boundary"}));
  EXPECT_THAT(notes, IsEmpty());
  // A large one is noted.
  Cells ring = unit_square();
  std::erase_if(ring.cells, [&](const std::vector<int>& cell) {
    return (ring.nodes[cell[0]] + ring.nodes[cell[1]] + ring.nodes[cell[2]] - Point(1.5, 1.5)).cwiseAbs().maxCoeff() <
           0.75;
  });
  ring.read(&notes);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], AllOf(HasSubstr("a hole of 16 edges around (0.5, 0.5)"), HasSubstr("'boundary'")));
}

TEST(ConformingMesh, ThinAndFlatMeshesConform) {
  for (const auto& [nx, ny, height] : {std::tuple(10, 1, 1e-5), {10, 3, 1e-5}, {1, 1, 1e-6}}) {
    Cells strip;
    strip.add_grid({0, 0}, {1, height}, nx, ny);
    for (const double angle : {0.0, 0.4}) EXPECT_NO_THROW(strip.read(nullptr, angle)) << nx << ' ' << ny;
  }
  // Two parts that are apart.
  Cells parts = unit_square(2, 2);
  parts.add_grid({1.1, 0}, {2, 1}, 2, 2);
  EXPECT_NO_THROW(parts.read());
}

/// Unit squares with a straight and a bent crack that cross, as gmsh's plug-in cuts them open, or not.
void write_cracks(const std::string& file, double version, bool is_cut, bool reaches_side) {
  const GmshModel model;
  model.run("write a file", [&] {
    for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) gmsh::model::geo::addPoint(x, y, 0, 0.15);
    std::vector<int> sides, crack;
    for (int i = 0; i < 4; ++i) sides.push_back(gmsh::model::geo::addLine(1 + i, 1 + (i + 1) % 4));
    const int a = gmsh::model::geo::addPoint(0.3, 0.4, 0, 0.1), b = gmsh::model::geo::addPoint(0.6, 0.5, 0, 0.1);
    const int c = reaches_side ? 2 : gmsh::model::geo::addPoint(0.8, 0.8, 0, 0.1);
    crack = {gmsh::model::geo::addLine(a, b), gmsh::model::geo::addLine(b, c)};
    gmsh::model::geo::addCurveLoop({1, 2, 3, 4}, 1);
    gmsh::model::geo::addPlaneSurface({1}, 1);
    gmsh::model::geo::synchronize();
    gmsh::model::mesh::embed(1, crack, 2, 1);
    const int group = gmsh::model::addPhysicalGroup(1, crack, 7);
    gmsh::model::setPhysicalName(1, group, "crack");
    gmsh::model::addPhysicalGroup(2, {1}, 8);
    gmsh::model::mesh::generate(2);
    if (is_cut) {
      gmsh::plugin::setNumber("Crack", "Dimension", 1);
      gmsh::plugin::setNumber("Crack", "PhysicalGroup", 7);
      gmsh::plugin::run("Crack");
    }
    gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::option::setNumber("Mesh.Binary", 0);
    gmsh::write(file);
  });
}

TEST(ConformingMesh, CracksOfGmshAreFractures) {
  const std::string file = testing::TempDir() + "sprekk_crack_" + std::to_string(getpid()) + ".msh";
  for (const double version : {2.2, 4.1})
    for (const bool reaches_side : {false, true}) {
      write_cracks(file, version, false, reaches_side);
      const Mesh closed = build_mesh(read_msh(file));
      write_cracks(file, version, true, reaches_side);
      const Mesh cut = build_mesh(read_msh(file));
      expect_consistent(cut);
      ASSERT_EQ(cut.fractures.size(), 1u);
      EXPECT_EQ(cut.fractures[0].name, "crack");
      EXPECT_EQ(cut.fracture_cell_count(), closed.fracture_cell_count());
      EXPECT_EQ(cut.node_count(), closed.node_count());
      EXPECT_EQ(cut.side_names, std::vector<std::string>{"boundary"});
      EXPECT_EQ(component_count(cut), 1);
      EXPECT_NEAR(fracture_length(cut, 0), fracture_length(closed, 0), 1e-14);
      EXPECT_EQ(euler_characteristic(cut), euler_characteristic(closed));
    }
}

TEST(ConformingMesh, CracksOfTwoGroupsAreRefused) {
  Cells halves;
  halves.add_grid({0, 0}, {1, 0.5}, 2, 1);
  halves.add_grid({0, 0.5}, {1, 1}, 2, 1);
  halves.groups = {"lower", "upper"};
  halves.lines = {{1, 3, 4}, {1, 4, 5}, {2, 6, 7}, {2, 7, 8}};
  EXPECT_THAT(halves.refusal(), HasSubstr("2 pairs of edges lie on one another"));
  // With one group it is a fracture from side to side.
  halves.lines = {{1, 3, 4}, {1, 4, 5}, {1, 6, 7}, {1, 7, 8}};
  const Mesh mesh = build_mesh(halves.read());
  expect_consistent(mesh);
  EXPECT_EQ(mesh.fracture_cell_count(), 2);
}

/// Refining a ring of cells with many outer edges, the time stays in proportion.
TEST(ConformingMesh, ManyOuterEdgesTakeLittleTime) {
  Cells strip;
  strip.add_grid({0, 0}, {20'000, 1}, 20'000, 1);
  const auto before = std::chrono::steady_clock::now();
  EXPECT_NO_THROW(strip.read());
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count(), 10);
}

}  // namespace
}  // namespace sprekk::test
