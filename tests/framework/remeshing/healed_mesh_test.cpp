#include "framework/remeshing/healed_mesh.hpp"

#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/remeshing/growth_checks.hpp"

namespace sprekk::test {
namespace {

using testing::HasSubstr;
using Reason = ExtensionError::Reason;

constexpr double size = 0.02;
constexpr CavityOptions usual{.radius = 5 * size, .size = size, .growth = 0.3};

/// Two fractures; the first has grown by two kinked cells at each end.
Mesh grown_mesh() {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = {fracture("main", {{0.9, 0.9}, {1.1, 1.1}}), fracture("wall", {{1.3, 0.8}, {1.3, 1.3}})};
  const Mesh mesh = generate_mesh(geometry, {.size = 0.1, .fracture_size = size});
  const Mesh once =
      extended(mesh, {replacing(mesh, 0, true, 0, size, 0.4), replacing(mesh, 0, false, 0, size, -0.2)}, usual).mesh;
  return extended(once, {replacing(once, 0, true, 0, 0.7 * size, -0.3), replacing(once, 0, false, 0, size, 0.5)}, usual)
      .mesh;
}

TEST(HealEnds, ClosesWallsAndKeepsCells) {
  const Mesh given = grown_mesh();
  const std::vector<PathExtension> extensions{replacing(given, 0, true, 2, size), replacing(given, 0, false, 1, size)};
  const HealedMesh healed = heal_ends(given, extensions);
  const Mesh& mesh = healed.mesh;
  expect_consistent(mesh);
  EXPECT_EQ(mesh.fracture_cell_count(), given.fracture_cell_count() - 3);
  EXPECT_EQ(mesh.face_count(), given.face_count() - 3);
  EXPECT_EQ(mesh.node_count(), given.node_count() - 3);  // the points before the old tips had two nodes each
  EXPECT_EQ(tip(mesh, 0, true), anchor(given, 0, true, 2));
  EXPECT_EQ(tip(mesh, 0, false), anchor(given, 0, false, 1));
  const auto& [name, first, count] = given.fractures[0];
  EXPECT_EQ(healed.replaced, (std::vector<std::vector<int>>{{first + count - 2, first + count - 1}, {first}}));
  EXPECT_EQ(healed.scars[0].front().from, tip(mesh, 0, true));
  EXPECT_EQ(healed.scars[0].back().to, tip(given, 0, true));
  EXPECT_EQ(healed.scars[1].front().to, tip(given, 0, false));

  for (int c = 0; c < mesh.cell_count(); ++c) {
    ASSERT_EQ(mesh.cell_center[c], given.cell_center[c]);
    for (int k = 0; k < mesh.cell_nodes[c].size(); ++k)
      ASSERT_EQ(mesh.nodes[mesh.cell_nodes[c][k]], given.nodes[given.cell_nodes[c][k]]);
  }
  int closed = 0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (healed.face[f] == none) {
      ++closed;
      EXPECT_NE(mesh.face_cells[f][1], none);
    } else {
      ASSERT_EQ(mesh.face_center[f], given.face_center[healed.face[f]]);
      ASSERT_EQ(mesh.face_cells[f][0], given.face_cells[healed.face[f]][0]);
    }
  }
  EXPECT_EQ(closed, 3);
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    ASSERT_EQ(mesh.fracture_cells[i].center, given.fracture_cells[healed.fracture_cell[i]].center);
    ASSERT_EQ(mesh.fracture_cells[i].grown, given.fracture_cells[healed.fracture_cell[i]].grown);
  }
  for (std::size_t p = 0; p < mesh.ridges.size(); ++p)
    ASSERT_EQ(mesh.ridges[p].center, given.ridges[healed.ridge[p]].center);
}

void expect_refused(const Mesh& mesh, const PathExtension& extension, Reason reason, const std::string& words) {
  const std::vector<PathExtension> extensions{{1, true, {{1.3, 1.4}}}, extension};
  try {
    extend_fractures(mesh, extensions, usual);
    ADD_FAILURE() << "was not refused: " << words;
  } catch (const ExtensionError& error) {
    EXPECT_EQ(error.reason(), reason) << error.what();
    EXPECT_EQ(error.extension(), 1);
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
  EXPECT_THROW(check_extensions(mesh, extensions, size), ExtensionError);
}

TEST(HealEnds, RefusesWhatCannotBeReplaced) {
  const Mesh mesh = grown_mesh();
  expect_refused(mesh, replacing(mesh, 0, true, 3, size), Reason::not_replaceable, "(it has not grown there)");
  expect_refused(mesh, replacing(mesh, 0, true, 1, -0.01 * size), Reason::not_replaceable, "becomes shorter");
  // The path is looked at from the anchor on: the old tip is no obstacle, a turn by more than 90 degrees is.
  expect_refused(mesh, replacing(mesh, 0, true, 1, size, 2.1), Reason::turns_back, "turns back");
  EXPECT_NO_THROW(extend_fractures(mesh, {replacing(mesh, 0, true, 1, 0, 0.8)}, usual));

  const GrownMesh at_wall = extended(mesh, {{0, true, {anchor(mesh, 1, true, 9)}}}, usual);
  ASSERT_EQ(at_wall.mesh.junctions.size(), 1u);
  expect_refused(at_wall.mesh, replacing(at_wall.mesh, 0, true, 1, size), Reason::no_tip, "at another fracture");
  const GrownMesh at_side = extended(mesh, {{0, true, {{1.1, 2.0}}}}, usual);
  expect_refused(at_side.mesh, replacing(at_side.mesh, 0, true, 1, size), Reason::no_tip, "on the outer boundary");

  for (const int replaced : {-1, mesh.fractures[0].cell_count}) {
    PathExtension extension = replacing(mesh, 0, true, 0, size);
    extension.replaced = replaced;
    EXPECT_THROW(extend_fractures(mesh, {extension}, usual), std::invalid_argument);
  }
}

TEST(HealEnds, RefusesCellsThatAnotherFractureMeets) {
  const Mesh mesh = grown_mesh();
  // The wall grows into a point between the grown cells of the first fracture: straight down from above.
  const Point joint = anchor(mesh, 0, true, 1);
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = {fracture("main", {{0.9, 0.9}, {1.1, 1.1}}),
                        fracture("wall", {joint + Point(-0.15, 0.3), joint + Point(-0.05, 0.1)})};
  Mesh joined = generate_mesh(geometry, {.size = 0.1, .fracture_size = size});
  for (const double angle : {0.4, -0.3})
    joined = extended(joined, {replacing(joined, 0, true, 0, size, angle)}, usual).mesh;
  joined = extended(joined, {{1, true, {anchor(joined, 0, true, 1)}}}, usual).mesh;
  ASSERT_EQ(joined.junctions.size(), 1u);
  for (const int replaced : {1, 2}) {
    try {
      heal_ends(joined, {replacing(joined, 0, true, replaced, size)});
      ADD_FAILURE() << "was not refused";
    } catch (const ExtensionError& error) {
      EXPECT_EQ(error.reason(), Reason::not_replaceable);
      EXPECT_THAT(error.what(), HasSubstr("another fracture meets it there"));
    }
  }
}

}  // namespace
}  // namespace sprekk::test
