#include "framework/remeshing/continued_mesh.hpp"

#include "framework/meshing/generate_mesh.hpp"
#include "framework/remeshing/move_tips.hpp"
#include "tests/framework/remeshing/random_network.hpp"

namespace sprekk::test {
namespace {

constexpr double size = 0.02;
constexpr CavityOptions usual{.radius = 4 * size, .size = size, .growth = 0.3};

/// A fracture at an angle that has grown by one cell at both ends, with kinks.
Mesh sample(double angle) {
  Geometry geometry = box(0, 2, 0, 2);
  const Point middle(1, 1), half = turned({0.1, 0}, angle);
  geometry.fractures = {fracture("main", {middle - half, middle + half})};
  const Mesh mesh = generate_mesh(geometry, {.size = 0.1, .fracture_size = size});
  return extended(mesh, {replacing(mesh, 0, false, 0, size, 0.4), replacing(mesh, 0, true, 0, size, -0.3)}, usual).mesh;
}

/// The last cell becomes longer by a part of itself and turns; with `first` it is divided there.
PathExtension going_on(const Mesh& mesh, bool at_end, double longer, double turn, std::optional<double> first = {}) {
  const Point tip_now = tip(mesh, 0, at_end), ahead = direction(mesh, 0, at_end), anchor = tip_now - size * ahead;
  PathExtension path{0, at_end, {}, 1, true, first.has_value()};
  if (first) path.points.push_back(anchor + *first * size * ahead);
  const Point from = first ? path.points[0] : anchor;
  const double left = first ? 1 - *first : 1;
  path.points.push_back(from + (left + longer) * size * turned(ahead, turn));
  return path;
}

class ContinuedMesh : public ::testing::TestWithParam<double> {};

TEST_P(ContinuedMesh, HasTheCellsThatWereThere) {
  const Mesh mesh = sample(GetParam());
  const std::vector<PathExtension> paths{going_on(mesh, false, 0.3, 0.1), going_on(mesh, true, 0.4, -0.1)};
  const std::optional<GrownMesh> same = continued_mesh(mesh, paths, usual);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->mesh.nodes, mesh.nodes);
  EXPECT_EQ(same->mesh.cell_nodes, mesh.cell_nodes);
  EXPECT_EQ(same->mesh.cell_faces, mesh.cell_faces);
  const std::optional<GrownMesh> moved = move_tips(mesh, *same, paths, usual);
  ASSERT_TRUE(moved);
  expect_sound(mesh, *moved);
  EXPECT_EQ(moved->mesh.cell_nodes, mesh.cell_nodes);
  for (const bool at_end : {false, true})
    EXPECT_LT((tip(moved->mesh, 0, at_end) - paths[at_end].points.back()).norm(), 1e-15);
  // A step without growth changes nothing at all.
  const std::vector<PathExtension> at_rest{going_on(mesh, false, 0, 0), going_on(mesh, true, 0, 0)};
  const std::optional<GrownMesh> still = move_tips(mesh, *continued_mesh(mesh, at_rest, usual), at_rest, usual);
  ASSERT_TRUE(still);
  for (int node = 0; node < mesh.node_count(); ++node)
    EXPECT_LT((still->mesh.nodes[node] - mesh.nodes[node]).norm(), 1e-14);
}

TEST_P(ContinuedMesh, DividesTheTrianglesBesideACellAndNoOthers) {
  const Mesh mesh = sample(GetParam());
  const std::vector<PathExtension> paths{going_on(mesh, false, 0.5, 0.1, 0.6), going_on(mesh, true, 0.4, -0.1)};
  const std::optional<GrownMesh> same = continued_mesh(mesh, paths, usual);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->mesh.cell_count(), mesh.cell_count() + 2);
  EXPECT_EQ(same->mesh.fracture_cell_count(), mesh.fracture_cell_count() + 1);
  EXPECT_EQ(same->extension_cells[0], (std::vector<int>{1, 0}));
  ASSERT_EQ(same->change.replaced_parts.size(), 3u);
  EXPECT_NEAR(same->change.replaced_parts[0].share, 0.6, 1e-12);
  EXPECT_NEAR(same->change.replaced_parts[1].share, 0.4, 1e-12);
  EXPECT_NEAR(same->change.replaced_parts[2].share, 1, 1e-12);
  const std::optional<GrownMesh> moved = move_tips(mesh, *same, paths, usual);
  ASSERT_TRUE(moved);
  expect_sound(mesh, *moved);
}

INSTANTIATE_TEST_SUITE_P(Angles, ContinuedMesh, ::testing::Values(0.0, 0.5236, 0.7854, 2.2));

TEST(ContinuedMesh, OnlyForTipsThatGoOn) {
  const Mesh mesh = sample(0.3);
  PathExtension kink = straight(mesh, 0, true, size, 0.2);
  kink.whole_segments = true;
  EXPECT_FALSE(continued_mesh(mesh, {kink}, usual));                                // a new cell
  EXPECT_FALSE(continued_mesh(mesh, {going_on(mesh, true, 0.5, 0, 0.02)}, usual));  // a sliver
  PathExtension many = going_on(mesh, true, 0.5, 0);
  many.whole_segments = false;
  EXPECT_FALSE(continued_mesh(mesh, {many}, usual));
}

}  // namespace
}  // namespace sprekk::test
